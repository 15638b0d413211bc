// How does a module of WebAssembly come from a file, bytes or another thread, and is it one of this package?
import { GnomonError } from './memory.js';

/** Version of the package: modules of another one have other structs. */
export const VERSION = '0.1.0';

// A module of one instruction with a vector: valid where SIMD is.
const SIMD = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11]);
export const HAS_SIMD = WebAssembly.validate(SIMD);

async function bytesOf(url) {
  if (url.protocol !== 'file:') {
    const response = await fetch(url);
    if (!response.ok) throw new GnomonError('wasm', `gnomon: ${url}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
  }
  const { readFile } = await import('node:fs/promises');
  return readFile(url);
}

async function moduleOf(source) {
  if (source instanceof WebAssembly.Module) return source;
  const bytes = source instanceof URL ? await bytesOf(source) : source;
  if (!(bytes instanceof ArrayBuffer || ArrayBuffer.isView(bytes))) throw new GnomonError('wasm', 'gnomon: wasm: expected a URL, bytes or a WebAssembly.Module');
  try {
    return await WebAssembly.compile(bytes);
  } catch (error) {
    throw new GnomonError('wasm', `gnomon: wasm: ${error.message}`);
  }
}

function versionOf({ memory, gnomon_version }) {
  const at = gnomon_version();
  const bytes = new Uint8Array(memory.buffer, at, 16);
  return String.fromCharCode(...bytes.subarray(0, bytes.indexOf(0)));
}

/** The exports of a module. `calls`: some that it must have; `imports`: all that it may import. */
export async function open(source, calls = ['gnomon_make_plan'], imports = {}) {
  const place = typeof source === 'string' ? new URL(source, globalThis.location?.href ?? import.meta.url) : source;
  const module = await moduleOf(place);
  const names = new Set(WebAssembly.Module.exports(module).map(({ name }) => name));
  for (const call of ['memory', '_initialize', 'gnomon_version', ...calls]) {
    if (!names.has(call)) throw new GnomonError('wasm', `gnomon: wasm: the module has no '${call}'`);
  }
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    if (!Object.hasOwn(imports, from) || !Object.hasOwn(imports[from], name)) throw new GnomonError('wasm', `gnomon: wasm: the module imports '${from}.${name}'`);
  }
  const { exports } = await WebAssembly.instantiate(module, imports);
  exports._initialize();
  const version = versionOf(exports);
  if (version !== VERSION) throw new GnomonError('wasm', `gnomon: wasm: version ${version}, expected ${VERSION}`);
  return exports;
}
