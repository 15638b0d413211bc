// What changes from frame to frame? Jittered grids, suns that turn slowly, followed depths, histories to try. full.d.ts is the manual.
import { Handle, History, depthsOf, exactly, objectOf } from './core.js';
import { GnomonError, constants, numberOf, structs, wholeIn } from './memory.js';

export function jitterTexels(gnomon, frame) {
  wholeIn(frame, 0, 2 ** 32 - 1, 'frame');
  return gnomon.call(16, (memory) => {
    const at = memory.allocate(16);
    memory.exports.gnomon_jitter_texels(frame, at);
    return memory.copy(at, 'f64', 2);
  });
}

export function jitter(gnomon, plan, offset) {
  const by = exactly(offset, 2, 'offset');
  return gnomon.call(constants.MAX_MAPS * structs.map.bytes, (memory, check) => {
    const at = gnomon.writePlan(memory, plan);
    const offsetAt = memory.numbers(by);
    check((field) => memory.exports.gnomon_jitter(at, offsetAt, field));
    return { ...plan, maps: gnomon.readMaps(memory, memory.value('plan', at, 'maps'), plan.maps.length) };
  });
}

export function holdSun(gnomon, input) {
  const { held = [0, 0, 0], sun, casters, mostPixels = 0.25, leastLightSine = 0.05, ...view } = objectOf(input, 'input');
  const { ready, bytes } = gnomon.prepare(view, ['camera', 'points', 'normals']);
  numberOf(mostPixels, 'most_pixels');
  numberOf(leastLightSine, 'least_light_sine');
  return gnomon.call(bytes, (memory, check) => {
    const at = gnomon.writeInput(memory, ready);
    const last = memory.numbers(exactly(held, 3, 'held'));
    const now = memory.numbers(exactly(sun, 3, 'sun'));
    const box = memory.numbers(exactly(casters, 6, 'casters'));
    const result = memory.allocate(structs.held_sun.bytes);
    check((field) => memory.exports.gnomon_hold_sun(at.view, last, now, box, mostPixels, leastLightSine, result, field));
    return memory.read('held_sun', result);
  });
}

export class DepthTracker extends Handle {
  constructor(gnomon, framesPerBin, holdFrames) {
    wholeIn(framesPerBin, 1, 65535, 'frames_per_bin');
    wholeIn(holdFrames, 1, 65535, 'hold_frames');
    super(gnomon, 'gnomon_depth_tracker_destroy', gnomon.memory.exports.gnomon_depth_tracker_create(framesPerBin, holdFrames));
  }
  update(frame) {
    const seen = depthsOf(frame, 'frame');
    return this.gnomon.call(4 * (seen.length ?? 0), (memory, check) => {
      const at = this.gnomon.writeDepths(memory, seen);
      check((field) => memory.exports.gnomon_depth_tracker_update(this.place(), at, at, field));
      return memory.read('visible_depths', at);
    });
  }
  clear() {
    this.gnomon.memory.exports.gnomon_depth_tracker_clear(this.place());
  }
}

export class FullHistory extends History {
  copy() {
    const from = this.place();
    const copy = this.gnomon.history();
    this.gnomon.memory.exports.gnomon_history_copy(from, copy.place());
    return copy;
  }
}
