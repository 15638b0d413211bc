// How do objects of JavaScript become structs of C in the memory of the module, and back? By the tables of layout.js alone.
import { constants, structs } from './layout.js';

const encoder = new TextEncoder();
const decoder = new TextDecoder();

// resolution_max_size <-> resolutionMaxSize
const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

/** Fields whose value is an index into a list, but has a name here. */
const LISTS = {
  warp: constants.WARPS,
  warp_shape: constants.SHAPES,
  shape: constants.SHAPES,
  fit: constants.FITS,
  split_scheme: constants.SPLITS,
  split_partition: constants.PARTITIONS,
  split_selection: constants.SELECTIONS,
  selection: constants.SELECTIONS,
  warp_objective: constants.OBJECTIVES,
  policy: constants.PAGE_POLICIES,
  status: constants.STATUSES,
};
const ENUMS = {
  split_range: ['automatic', 'receivers', 'camera'],
  kind_of_light: ['directional', 'spot', 'point'],
};
const FLAGS = new Set(['orthographic', 'zero_to_one', 'reversed_z', 'y_down', 'left_handed', 'first_row_at_y_max', 'snap_valid',
  'sizes_vary', 'fallback', 'changed', 'due', 'repacked']);
// A count in one struct, a flag in another.
const COUNTS = new Set(['light_plan.due']);
// Lists that may be shorter than their place.
const SHORTER = new Set(['split_given', 'warp_planes', 'cull_planes', 'select_planes', 'shape_parameters', 'place']);
const ARRAYS = { f64: Float64Array, f32: Float32Array, i32: Int32Array, u32: Uint32Array, u8: Uint8Array };

/** Fields by struct and by their name in JavaScript. */
const tables = {};
for (const [struct, { fields }] of Object.entries(structs)) {
  tables[struct] = new Map();
  for (const [name, [offset, kind, count]] of Object.entries(fields)) {
    if (name === 'size' || name === 'reserved') continue;
    const list = struct === 'light' && name === 'kind' ? ENUMS.kind_of_light : ENUMS[name];
    const registry = struct === 'point_error' ? undefined : LISTS[name];
    tables[struct].set(camel(name), { name, offset, kind, count, list, registry, flag: FLAGS.has(name) && !COUNTS.has(`${struct}.${name}`) });
  }
}

/** What a call refuses: `field` is its name in the C header, such as "camera.far_depth". */
export class GnomonError extends Error {
  constructor(field, message) {
    super(message ?? `gnomon: not usable: ${field}`);
    this.name = 'GnomonError';
    this.field = field;
  }
}

/**
 * The same list of numbers, as a typed or plain array. What is no number would become 0 or NaN without a word, and what was
 * transferred to another thread an empty list.
 */
export function numbersOf(values, name) {
  const refuse = (why) => { throw new GnomonError(name, `gnomon: ${name}: ${why}`); };
  if (ArrayBuffer.isView(values) && values.BYTES_PER_ELEMENT !== undefined) {
    if (typeof values[0] === 'bigint') refuse('expected numbers');
    try {
      if (values.length === 0) new Uint8Array(values.buffer);
    } catch {
      refuse('its buffer is detached');
    }
    return values;
  }
  if (values === null || typeof values !== 'object' || !Number.isInteger(values.length)) refuse('expected numbers');
  const list = Array.isArray(values) ? values : Array.from(values);
  for (const value of list) {
    if (typeof value !== 'number') refuse('expected numbers');
  }
  return list;
}

/** A whole number of 32 bits. */
export function wholeOf(value, name) {
  if (!Number.isInteger(value) || value < -(2 ** 31) || value >= 2 ** 32) throw new GnomonError(name, `gnomon: ${name}: expected a whole number of 32 bits`);
  return value;
}

/** The same within bounds. */
export function wholeIn(value, least, most, name) {
  if (wholeOf(value, name) < least || value > most) throw new GnomonError(name, `gnomon: ${name}: expected ${least}..${most}`);
  return value;
}

export function numberOf(value, name) {
  if (typeof value !== 'number') throw new GnomonError(name, `gnomon: ${name}: expected a number`);
  return value;
}

/** The memory of a module. What is allocated in a call is freed at its end; nothing is freed one by one. */
export class Memory {
  constructor(exports) {
    this.exports = exports;
    this.block = 0;
    this.room = 0;
    this.used = 0;
    this.names = new Map();
    this.indices = new Map();
  }

  get view() {
    // Memory that grew has a new buffer.
    if (this.cached?.buffer !== this.exports.memory.buffer) this.cached = new DataView(this.exports.memory.buffer);
    return this.cached;
  }

  /**
   * Runs `work` with memory of its own, at least `bytes`: enough for all that it allocates. A call within a call takes another
   * block where the first one has too little left.
   */
  scratch(bytes, work) {
    const { block, room, used } = this;
    const another = used > 0 && used + bytes > room;
    if (used === 0 && bytes > room) {
      this.exports.free(block);
      this.block = this.room = 0;
    }
    if (used + bytes > room) this.takeBlock(bytes);
    try {
      return work();
    } finally {
      if (another) {
        this.exports.free(this.block);
        Object.assign(this, { block, room });
      }
      this.used = used;
    }
  }

  takeBlock(bytes) {
    const room = Math.max(bytes, 1 << 16);
    const block = room < 2 ** 31 ? this.exports.malloc(room) >>> 0 : 0;
    if (block === 0) throw new GnomonError('memory', `gnomon: no memory for ${bytes} bytes`);
    Object.assign(this, { block, room, used: 0 });
  }

  allocate(bytes) {
    const at = this.block + this.used;
    this.used += (bytes + 15) & ~15;
    if (this.used > this.room) throw new GnomonError('memory', 'gnomon: more was allocated than was counted');
    return at;
  }

  text(at) {
    const bytes = new Uint8Array(this.exports.memory.buffer, at);
    let end = 0;
    while (bytes[end] !== 0) ++end;
    return decoder.decode(bytes.subarray(0, end));
  }

  /** Index of a name in a list of the registry. */
  indexOf(list, name, field) {
    if (typeof name !== 'string' || name.length > 256) throw new GnomonError(field, `gnomon: ${field}: expected a name`);
    const key = `${list} ${name}`;
    let index = this.indices.get(key);
    if (index === undefined) {
      index = this.scratch(name.length * 3 + 16, () => {
        const at = this.allocate(name.length * 3 + 1);
        const bytes = encoder.encode(name + '\0');
        new Uint8Array(this.exports.memory.buffer, at, bytes.length).set(bytes);
        return this.exports.gnomon_find(list, at);
      });
      if (index === constants.UNKNOWN) throw new GnomonError(field, `gnomon: ${field}: there is no '${name}'`);
      this.indices.set(key, index);
    }
    return index;
  }

  nameOf(list, index) {
    if (index === constants.DEFAULT) return null;
    const key = `${list} ${index}`;
    if (!this.names.has(key)) {
      const at = this.exports.gnomon_name(list, index);
      this.names.set(key, at === 0 ? null : this.text(at));
    }
    return this.names.get(key);
  }

  /** Numbers of a typed array, a plain one or nested ones, at a place of their own. Returns the place. */
  numbers(values, kind = 'f64') {
    const Kind = ARRAYS[kind];
    const at = this.allocate(values.length * Kind.BYTES_PER_ELEMENT);
    new Kind(this.exports.memory.buffer, at, values.length).set(values);
    return at;
  }

  /** A copy of `count` numbers. */
  copy(at, kind, count) {
    const Kind = ARRAYS[kind];
    return new Kind(this.exports.memory.buffer.slice(at, at + count * Kind.BYTES_PER_ELEMENT));
  }

  clear(at, bytes) {
    new Uint8Array(this.exports.memory.buffer, at, bytes).fill(0);
  }

  struct(name, at = this.allocate(structs[name].bytes)) {
    this.exports[`gnomon_${name}_default`](at, structs[name].bytes);
    return at;
  }

  /** Sets the fields of a struct that `object` has. Refuses keys that it has none of, unless they are in `others`. */
  write(struct, at, object, others = []) {
    if (object === null || typeof object !== 'object') throw new GnomonError(struct, `gnomon: ${struct}: expected an object`);
    for (const key of Object.keys(object)) {
      if (object[key] === undefined || others.includes(key)) continue;
      const field = tables[struct].get(key);
      const path = `${struct}.${field?.name ?? key}`;
      if (field === undefined || field.kind === 'ptr') throw new GnomonError(path, `gnomon: ${struct} has no field '${key}'`);
      this.writeField(field, at + field.offset, object[key], path);
    }
  }

  writeField({ kind, count, list, registry, flag }, at, value, path) {
    if (kind in structs) {
      if (count > 0 && !(Array.isArray(value) && value.length <= count)) throw new GnomonError(path, `gnomon: ${path}: expected at most ${count} objects`);
      if (count > 0) value.forEach((one, i) => this.write(kind, at + i * structs[kind].bytes, one));
      else this.write(kind, at, value);
    } else if (count > 0) {
      const flat = numbersOf(Array.isArray(value) ? value.flat() : value, path);
      const name = path.slice(path.indexOf('.') + 1);
      if (flat.length > count || (flat.length < count && !SHORTER.has(name))) throw new GnomonError(path, `gnomon: ${path}: expected ${count} numbers`);
      new ARRAYS[kind](this.exports.memory.buffer, at, count).set(flat);
    } else if (kind === 'i64') {
      if (!Number.isInteger(value)) throw new GnomonError(path, `gnomon: ${path}: expected a whole number`);
      this.view.setBigInt64(at, BigInt(value), true);
    } else if (list !== undefined && typeof value === 'string') {
      if (!list.includes(value)) throw new GnomonError(path, `gnomon: ${path}: there is no '${value}'`);
      this.view.setInt32(at, list.indexOf(value), true);
    } else if (registry !== undefined && (typeof value === 'string' || value === null)) {
      this.view.setInt32(at, value === null ? constants.DEFAULT : this.indexOf(registry, value, path), true);
    } else {
      this.writeNumber(kind, at, flag ? Number(Boolean(value)) : value, path);
    }
  }

  writeNumber(kind, at, value, path) {
    numberOf(value, path);
    if (kind === 'f64') this.view.setFloat64(at, value, true);
    else if (kind === 'f32') this.view.setFloat32(at, value, true);
    // What is no whole number of 32 bits would become another one without a word.
    else this.view.setInt32(at, wholeOf(value, path) | 0, true);
  }

  read(struct, at) {
    const object = {};
    for (const [key, field] of tables[struct]) {
      if (field.kind !== 'ptr') object[key] = this.readField(field, at + field.offset);
    }
    return object;
  }

  readField({ kind, count, list, registry, flag }, at) {
    if (kind in structs) {
      if (count === 0) return this.read(kind, at);
      return Array.from({ length: count }, (_, i) => this.read(kind, at + i * structs[kind].bytes));
    }
    if (kind === 'char') return this.text(at);
    if (count > 0) return this.copy(at, kind, count);
    if (kind === 'f64') return this.view.getFloat64(at, true);
    if (kind === 'f32') return this.view.getFloat32(at, true);
    if (kind === 'i64') return Number(this.view.getBigInt64(at, true));
    if (kind === 'u32') return this.view.getUint32(at, true);
    const value = this.view.getInt32(at, true);
    if (list !== undefined) return list[value];
    if (registry !== undefined) return this.nameOf(registry, value);
    return flag ? value !== 0 : value;
  }

  pointer(struct, at, field, value) {
    this.view.setUint32(at + structs[struct].fields[field][0], value, true);
  }
  integer(struct, at, field, value) {
    const [offset, kind] = structs[struct].fields[field];
    if (kind === 'i64') this.view.setBigInt64(at + offset, BigInt(value), true);
    else this.view.setInt32(at + offset, value, true);
  }
  value(struct, at, field) {
    const [offset, kind] = structs[struct].fields[field];
    if (kind === 'ptr') return this.view.getUint32(at + offset, true);
    return kind === 'i64' ? Number(this.view.getBigInt64(at + offset, true)) : this.view.getInt32(at + offset, true);
  }
}

export { constants, structs };
