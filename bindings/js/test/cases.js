// The cases of c_dump_cases, as raw bytes of C structs and as objects.
import { readFileSync } from 'node:fs';
import { structs } from '../layout.js';

export function readCases(path) {
  const bytes = readFileSync(path);
  let at = 4;
  const take = (size) => bytes.subarray(at, (at += size));
  const number = () => take(4).readInt32LE();
  return Array.from({ length: bytes.readUInt32LE(0) }, () => {
    const one = { camera: take(structs.camera.bytes), light: take(structs.light.bytes), options: take(structs.plan_options.bytes) };
    const [casters, receivers] = [number(), number()];
    one.casters = doubles(take(casters * 48));
    one.receivers = doubles(take(receivers * 48));
    one.status = number();
    one.mapCount = number();
    one.maps = Array.from({ length: one.mapCount }, () => take(structs.map.bytes));
    one.stats = one.status === 0 ? take(structs.stats.bytes) : undefined;
    return one;
  });
}

const doubles = (bytes) => new Float64Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
