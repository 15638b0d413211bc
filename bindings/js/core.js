// How do plans, histories and errors go through the C interface of a module? index.d.ts is the manual.
import { GnomonError, Memory, constants, numberOf, numbersOf, structs, wholeOf } from './memory.js';

const MAPS = constants.MAX_MAPS;
const OMISSIONS = constants.MAX_OMISSIONS;
// Names of C's constants by their numbers.
export const OMISSION_KINDS = ['cascadeWithoutReceiver', 'cascadeWithoutCaster', 'depthWithoutReceiver', 'depthNotVisible',
  'warpWithoutGain', 'warpInStableFit', 'partWithoutCaster', 'partitionWithoutGain', 'partitionInStableFit',
  'faceWithoutReceiver', 'faceWithoutCaster', 'resolutionWithoutGain', 'depthNearLight', 'optionIgnored',
  'viewWithoutReceiver', 'pagesCoarsened', 'pointsLeftCoarser', 'pointsBeyondLevels', 'shapeWithoutGain',
  'planeWithoutReceiver', 'planeWithoutCaster', 'cascadeOnPlanes', 'facesLessDivided', 'receiverNearLight', 'cascadeWithoutGain'];
export const IGNORED = ['splitPartition', 'splitScheme', 'splitOverlap', 'depths', 'resolutionTexelBudget', 'history', 'splitSelection',
  'cadenceFrames', 'points', 'warpShape', 'warpPlanes', 'share', 'reachTexels'];
export const EVENT_KINDS = ['mapAppeared', 'mapRefitted', 'densityJump'];
export const REUSE_KINDS = ['none', 'identical', 'scrolled'];
export const POINT_STATUS = ['ok', 'outside', 'facesAway', 'undetermined'];

// Handles that nobody destroyed are freed with their object.
const handles = new FinalizationRegistry(({ exports, destroy, at }) => exports[destroy](at));

/** Owns a handle of the module. */
export class Handle {
  constructor(gnomon, destroy, at) {
    if (at === 0) throw new GnomonError('memory', 'gnomon: no memory');
    this.gnomon = gnomon;
    this.destroy = destroy;
    this.at = at;
    handles.register(this, { exports: gnomon.memory.exports, destroy, at }, this);
  }
  place() {
    if (this.at === 0) throw new GnomonError('disposed', 'gnomon: used after dispose()');
    return this.at;
  }
  dispose() {
    if (this.at === 0) return;
    handles.unregister(this);
    this.gnomon.memory.exports[this.destroy](this.at);
    this.at = 0;
  }
}

export class History extends Handle {
  constructor(gnomon) {
    super(gnomon, 'gnomon_history_destroy', gnomon.memory.exports.gnomon_history_create());
  }
  clear() {
    this.gnomon.memory.exports.gnomon_history_clear(this.place());
  }
  get events() {
    const { memory } = this.gnomon;
    return memory.scratch(MAPS * structs.event.bytes, () => {
      const at = memory.allocate(MAPS * structs.event.bytes);
      const count = memory.exports.gnomon_history_events(this.place(), at, MAPS);
      return Array.from({ length: count }, (_, i) => {
        const event = memory.read('event', at + i * structs.event.bytes);
        return { ...event, kind: EVENT_KINDS[event.kind] };
      });
    });
  }
}

export class CasterSet extends Handle {
  constructor(gnomon, at, count) {
    super(gnomon, 'gnomon_caster_set_destroy', at);
    this.count = count;
  }
  refit(boxes) {
    const flat = boxesOf(boxes, 'boxes');
    this.gnomon.call(flat.length * 8, (memory, check) => {
      const at = memory.numbers(flat);
      check((field) => memory.exports.gnomon_caster_set_refit(this.place(), at, BigInt(flat.length / 6), field));
    });
  }
  update(index, box) {
    const flat = boxesOf([box], 'box');
    if (!Number.isInteger(index)) throw new GnomonError('index', 'gnomon: index: expected a whole number');
    this.gnomon.call(64, (memory, check) => {
      const at = memory.numbers(flat);
      check((field) => memory.exports.gnomon_caster_set_update(this.place(), BigInt(index), at, field));
    });
  }
}

/** Numbers in one typed or plain array, `each` at a time. */
export function flatten(values, each, name) {
  const nested = Array.isArray(values) && typeof values[0] === 'object';
  const flat = nested ? values.flatMap((one) => Array.from(exactly(one, each, name))) : numbersOf(values, name);
  if (flat.length % each !== 0) throw new GnomonError(name, `gnomon: ${name}: expected ${each} numbers each`);
  return flat;
}
export function exactly(values, count, name) {
  const flat = numbersOf(values, name);
  if (flat.length !== count) throw new GnomonError(name, `gnomon: ${name}: expected ${count} numbers`);
  return flat;
}
export function objectOf(value, name) {
  if (value === null || typeof value !== 'object') throw new GnomonError(name, `gnomon: ${name}: expected an object`);
  return value;
}
// Visible points that a call without points samples the receivers with.
const SAMPLES = 16384;
/** Points that a prepared input has or is sampled with. */
export const pointCount = ({ points }) => (points === undefined ? SAMPLES : points.length / 3);
export const boxesOf = (values, name) => flatten(values, 6, name);
export const pointsOf = (values, name) => flatten(values, 3, name);
/** View depths of pixels, or those that were counted before. */
export const depthsOf = (values, name) => (values?.count === undefined ? numbersOf(values, name) : values);

const PLAN_KEYS = ['camera', 'light', 'casters', 'receivers', 'points', 'normals', 'depths', 'options', 'history'];

export class Gnomon {
  constructor(exports) {
    this.memory = new Memory(exports);
    this.version = this.memory.text(exports.gnomon_version());
  }

  /** Runs `work` in memory of its own; `check` turns a refusal into an error. */
  call(bytes, work) {
    const { memory } = this;
    return memory.scratch(bytes + 4096, () => {
      const field = memory.allocate(4);
      const check = (run) => {
        const status = run(field);
        if (status === constants.OUT_OF_MEMORY) throw new GnomonError('memory', 'gnomon: no memory');
        if (status === constants.INVALID_INPUT) throw new GnomonError(memory.text(memory.view.getUint32(field, true)));
        return status;
      };
      return work(memory, check);
    });
  }

  /** The place of a handle of this module. */
  placeOf(handle, Kind, name) {
    if (!(handle instanceof Kind) || handle.gnomon !== this) throw new GnomonError(name, `gnomon: ${name}: expected one that this module made`);
    return handle.place();
  }

  names(list) {
    const lists = { warps: 'WARPS', shapes: 'SHAPES', fits: 'FITS', splits: 'SPLITS', partitions: 'PARTITIONS',
      selections: 'SELECTIONS', objectives: 'OBJECTIVES', pruneRules: 'PRUNE_RULES', pagePolicies: 'PAGE_POLICIES' };
    if (!(list in lists)) throw new GnomonError('list', `gnomon: there is no list '${list}'`);
    const { memory } = this;
    const index = constants[lists[list]];
    return Array.from({ length: memory.exports.gnomon_count(index) }, (_, i) =>
      ({ name: memory.nameOf(index, i), summary: memory.text(memory.exports.gnomon_summary(index, i)) }));
  }

  history() {
    return new History(this);
  }

  casterSet(boxes) {
    const flat = boxesOf(boxes, 'boxes');
    return this.call(flat.length * 8 + 16, (memory, check) => {
      const at = memory.numbers(flat);
      const place = memory.allocate(4);
      check((field) => memory.exports.gnomon_caster_set_create(at, BigInt(flat.length / 6), place, field));
      return new CasterSet(this, memory.view.getUint32(place, true), flat.length / 6);
    });
  }

  perspective(image) {
    return this.image('gnomon_perspective', 'fov_y', objectOf(image, 'camera').fovY, image);
  }
  orthographic(image) {
    return this.image('gnomon_orthographic', 'height_world', objectOf(image, 'camera').heightWorld, image);
  }
  image(make, name, size, { position, forward, up, aspect = 1, near = 0.1, far = 100, width = 1920, height = 1080 }) {
    for (const [field, value] of [[name, size], ['aspect', aspect], ['near_depth', near], ['far_depth', far]]) numberOf(value, field);
    wholeOf(width, 'width');
    wholeOf(height, 'height');
    return this.call(0, (memory, check) => {
      const at = memory.struct('camera');
      memory.write('camera', at, { position, forward, up });
      check((field) => memory.exports[make](at, size, aspect, near, far, width, height, field));
      return memory.read('camera', at);
    });
  }

  cameraFrom(matrices) {
    const { viewFromWorld, clipFromView, clipSpace = {}, width, height } = objectOf(matrices, 'camera');
    wholeOf(width, 'width');
    wholeOf(height, 'height');
    return this.call(0, (memory, check) => {
      const at = memory.struct('camera');
      const space = this.writeFixed(memory, 'clip_space', clipSpace);
      const view = memory.numbers(exactly(viewFromWorld, 16, 'view_from_world'));
      const clip = memory.numbers(exactly(clipFromView, 16, 'clip_from_view'));
      const why = memory.allocate(4);
      try {
        check((field) => memory.exports.gnomon_camera_from(view, clip, space, width, height, at, why, field));
      } catch (error) {
        const reason = memory.view.getUint32(why, true);
        throw reason === 0 ? error : new GnomonError(error.field, `gnomon: ${memory.text(reason)}`);
      }
      return memory.read('camera', at);
    });
  }

  /** Writes a struct whose size is fixed; what `object` has nothing of is zero. */
  writeFixed(memory, struct, object) {
    const at = memory.allocate(structs[struct].bytes);
    memory.clear(at, structs[struct].bytes);
    memory.write(struct, at, object);
    return at;
  }

  /** Writes camera, view, light and scene; what is not given is not written. */
  writeInput(memory, { camera, light, casters, receivers, points, normals, depths }) {
    const at = {};
    at.camera = memory.struct('camera');
    memory.write('camera', at.camera, camera);
    at.view = memory.struct('view');
    memory.pointer('view', at.view, 'camera', at.camera);
    if (points !== undefined) {
      memory.pointer('view', at.view, 'points', memory.numbers(points));
      memory.integer('view', at.view, 'point_count', points.length / 3);
      if (normals !== undefined) {
        if (normals.length !== points.length) throw new GnomonError('view.normals');
        memory.pointer('view', at.view, 'normals', memory.numbers(normals));
      }
    }
    if (depths !== undefined) memory.pointer('view', at.view, 'depths', this.writeDepths(memory, depths));
    if (light !== undefined) {
      at.light = memory.struct('light');
      memory.write('light', at.light, light);
    }
    at.scene = memory.struct('scene');
    for (const [name, boxes] of [['caster', casters], ['receiver', receivers]]) {
      if (boxes instanceof CasterSet) {
        memory.pointer('scene', at.scene, `${name}_set`, this.placeOf(boxes, CasterSet, `scene.${name}s`));
      } else {
        const same = name === 'receiver' && boxes === casters;
        at[name] = same ? at.caster : memory.numbers(boxes);
        memory.pointer('scene', at.scene, `${name}s`, at[name]);
        memory.integer('scene', at.scene, `${name}_count`, boxes.length / 6);
      }
    }
    return at;
  }

  writeDepths(memory, depths) {
    const at = memory.allocate(structs.visible_depths.bytes);
    memory.exports.gnomon_visible_depths_clear(at);
    if (depths.count !== undefined) memory.write('visible_depths', at, depths);
    else memory.exports.gnomon_visible_depths_add(at, memory.numbers(depths, 'f32'), BigInt(depths.length), 0);
    return at;
  }

  /** Input with flat lists, and the bytes that it takes. */
  prepare(input, keys = PLAN_KEYS) {
    objectOf(input, 'input');
    for (const key of Object.keys(input)) {
      if (!keys.includes(key) && input[key] !== undefined) throw new GnomonError(key, `gnomon: there is no input '${key}'`);
    }
    const ready = { ...input };
    let bytes = 8192;
    for (const key of ['casters', 'receivers']) {
      const boxes = input[key] ?? [];
      ready[key] = boxes instanceof CasterSet ? boxes : boxesOf(boxes, `scene.${key}`);
      bytes += boxes instanceof CasterSet ? 0 : 8 * ready[key].length;
    }
    // One list for both is written once.
    if (input.receivers === input.casters) ready.receivers = ready.casters;
    for (const key of ['points', 'normals']) {
      if (input[key] === undefined) continue;
      ready[key] = pointsOf(input[key], `view.${key}`);
      bytes += 8 * ready[key].length;
    }
    if (input.depths !== undefined) bytes += 4 * ((ready.depths = depthsOf(input.depths, 'view.depths')).length ?? 0);
    return { ready, bytes };
  }

  plan(input) {
    const { ready, bytes } = this.prepare(input);
    return this.planBy(ready, bytes, (memory, at, options, plan, field) => {
      const history = ready.history === undefined ? 0 : this.placeOf(ready.history, History, 'history');
      return memory.exports.gnomon_make_plan(at.view, at.light, at.scene, options, history, plan, field);
    });
  }

  /** A plan by the call that `make` makes. */
  planBy(ready, bytes, make) {
    const results = MAPS * structs.map.bytes + OMISSIONS * structs.omission.bytes;
    return this.call(bytes + results, (memory, check) => {
      const at = this.writeInput(memory, ready);
      if (at.light === undefined) throw new GnomonError('light');
      const options = memory.struct('plan_options');
      this.writeOptions(memory, options, ready.options ?? {});
      const plan = memory.struct('plan');
      const maps = memory.allocate(MAPS * structs.map.bytes);
      const omissions = memory.allocate(OMISSIONS * structs.omission.bytes);
      memory.pointer('plan', plan, 'maps', maps);
      memory.integer('plan', plan, 'map_size', structs.map.bytes);
      memory.integer('plan', plan, 'map_room', MAPS);
      memory.pointer('plan', plan, 'omissions', omissions);
      memory.integer('plan', plan, 'omission_room', OMISSIONS);
      check((field) => make(memory, at, options, plan, field));
      return this.readPlan(memory, plan, maps, omissions);
    });
  }

  writeOptions(memory, at, options) {
    memory.write('plan_options', at, options, ['prune']);
    if (options.prune === undefined) return;
    let bits = 0;
    if (!Array.isArray(options.prune)) throw new GnomonError('plan_options.prune', 'gnomon: plan_options.prune: expected names');
    for (const rule of options.prune) bits |= 1 << memory.indexOf(constants.PRUNE_RULES, rule, 'plan_options.prune');
    memory.integer('plan_options', at, 'prune', bits);
  }

  readPlan(memory, at, maps, omissions) {
    const { mapSize, mapRoom, omissionRoom, mapCount, omissionCount, ...plan } = memory.read('plan', at);
    plan.maps = this.readMaps(memory, maps, mapCount);
    plan.omitted = Array.from({ length: Math.min(omissionCount, OMISSIONS) }, (_, i) =>
      this.readOmission(memory, omissions + i * structs.omission.bytes));
    return plan;
  }

  readMaps(memory, maps, count) {
    return Array.from({ length: count }, (_, i) => memory.read('map', maps + i * structs.map.bytes));
  }

  readOmission(memory, at) {
    const omission = memory.read('omission', at);
    if (omission.kind === constants.OPTION_IGNORED) return { ...omission, kind: 'optionIgnored', option: IGNORED[omission.a] };
    return { ...omission, kind: OMISSION_KINDS[omission.kind] };
  }

  /** A plan of JavaScript as one of C: those of plan(), or one of foreign matrices. */
  writePlan(memory, plan) {
    const { maps, status = 'ok', omitted, ...rest } = objectOf(plan, 'plan');
    if (!Array.isArray(maps)) throw new GnomonError('plan.maps', 'gnomon: plan.maps: expected an array');
    const at = memory.struct('plan');
    memory.write('plan', at, { ...rest, status });
    const first = memory.allocate(MAPS * structs.map.bytes);
    if (maps.length > MAPS) throw new GnomonError('plan.map_count');
    maps.forEach((map, i) => memory.write('map', memory.struct('map', first + i * structs.map.bytes), map));
    memory.pointer('plan', at, 'maps', first);
    memory.integer('plan', at, 'map_size', structs.map.bytes);
    memory.integer('plan', at, 'map_room', maps.length);
    memory.integer('plan', at, 'map_count', maps.length);
    return at;
  }

  measure(plan, view) {
    const { grid = {}, ...input } = objectOf(view, 'input');
    const { ready, bytes } = this.prepare(input);
    return this.call(bytes + MAPS * structs.map.bytes, (memory, check) => {
      const at = this.writeInput(memory, ready);
      const planAt = this.writePlan(memory, plan);
      const options = memory.struct('measure_options');
      memory.write('measure_options', options, grid);
      const stats = memory.struct('stats');
      check((field) => memory.exports.gnomon_measure(planAt, at.view, at.scene, options, stats, field));
      return memory.read('stats', stats);
    });
  }

  measurePoints(map, input) {
    const { camera, points, normals } = objectOf(input, 'input');
    const flat = pointsOf(points, 'points');
    const facing = normals === undefined ? undefined : pointsOf(normals, 'normals');
    if (facing !== undefined && facing.length !== flat.length) throw new GnomonError('normals');
    const count = flat.length / 3;
    return this.call(structs.map.bytes + flat.length * 16 + count * structs.point_error.bytes, (memory, check) => {
      const cameraAt = memory.struct('camera');
      memory.write('camera', cameraAt, camera);
      const mapAt = memory.struct('map');
      memory.write('map', mapAt, map);
      const pointsAt = memory.numbers(flat);
      const normalsAt = facing === undefined ? 0 : memory.numbers(facing);
      const errors = memory.allocate(count * structs.point_error.bytes);
      check((field) => memory.exports.gnomon_measure_points(mapAt, cameraAt, pointsAt, normalsAt, BigInt(count), errors, field));
      return Array.from({ length: count }, (_, i) => {
        const error = memory.read('point_error', errors + i * structs.point_error.bytes);
        return { ...error, status: POINT_STATUS[error.status] };
      });
    });
  }

  select(plan, points, viewDepths) {
    const flat = pointsOf(points, 'points');
    const count = flat.length / 3;
    exactly(viewDepths, count, 'view_depths');
    return this.call(MAPS * structs.map.bytes + flat.length * 8 + count * 12, (memory, check) => {
      const planAt = this.writePlan(memory, plan);
      const pointsAt = memory.numbers(flat);
      const depths = memory.numbers(viewDepths);
      const indices = memory.allocate(count * 4);
      check((field) => memory.exports.gnomon_select(planAt, pointsAt, depths, BigInt(count), indices, field));
      return memory.copy(indices, 'i32', count);
    });
  }

  cull(map, casters) {
    const set = casters instanceof CasterSet;
    const flat = set ? [] : boxesOf(casters, 'casters');
    const room = set ? casters.count : flat.length / 6;
    return this.call(structs.map.bytes + flat.length * 8 + room * 4 + 16, (memory, check) => {
      const mapAt = memory.struct('map');
      memory.write('map', mapAt, map);
      const indices = memory.allocate(room * 4);
      const found = memory.allocate(8);
      if (set) {
        const place = this.placeOf(casters, CasterSet, 'casters');
        check((field) => memory.exports.gnomon_cull_set(mapAt, place, indices, BigInt(room), found, field));
      } else {
        const boxes = memory.numbers(flat);
        check((field) => memory.exports.gnomon_cull(mapAt, boxes, BigInt(room), indices, BigInt(room), found, field));
      }
      return memory.copy(indices, 'u32', Number(memory.view.getBigInt64(found, true)));
    });
  }

  rebased(map, origin) {
    return this.call(2 * structs.map.bytes, (memory, check) => {
      const from = memory.struct('map');
      memory.write('map', from, map);
      const to = memory.struct('map');
      const at = memory.numbers(exactly(origin, 3, 'origin'));
      check((field) => memory.exports.gnomon_rebased(from, at, to, field));
      return memory.read('map', to);
    });
  }

  compare(previous, current, clipSpace = {}) {
    return this.call(2 * structs.map.bytes, (memory, check) => {
      const maps = [previous, current].map((map) => {
        const at = memory.struct('map');
        memory.write('map', at, map);
        return at;
      });
      const space = this.writeFixed(memory, 'clip_space', clipSpace);
      const reuse = memory.allocate(structs.reuse.bytes);
      check((field) => memory.exports.gnomon_compare(maps[0], maps[1], space, reuse, field));
      const { kind, stripCount, strip, ...rest } = memory.read('reuse', reuse);
      return { kind: REUSE_KINDS[kind], ...rest, strips: strip.slice(0, stripCount) };
    });
  }

  shaderBlock(plan, { layerWidth = 0, layerHeight = 0, blurTexels = 0 } = {}) {
    const floats = constants.SHADER_BLOCK_FLOATS;
    wholeOf(layerWidth, 'layer_width');
    wholeOf(layerHeight, 'layer_height');
    return this.call(MAPS * structs.map.bytes + floats * 4, (memory, check) => {
      const planAt = this.writePlan(memory, plan);
      const block = memory.allocate(floats * 4);
      check((field) => memory.exports.gnomon_shader_block(planAt, layerWidth, layerHeight, blurTexels, block, field));
      return memory.copy(block, 'f32', floats);
    });
  }

  textureFromClip(clipSpace = {}) {
    return this.call(256, (memory) => {
      const space = this.writeFixed(memory, 'clip_space', clipSpace);
      const at = memory.allocate(128);
      memory.exports.gnomon_texture_from_clip(space, at);
      return memory.copy(at, 'f64', 16);
    });
  }
}
