// How do pages go through the C interface? full.d.ts is the manual.
import { Handle, boxesOf, pointCount, pointsOf } from './core.js';
import { GnomonError, constants, numbersOf, structs, wholeOf } from './memory.js';

const PLAN = (structs.page_plan.bytes + 15) & ~15;

/** Memory of its own in the module, freed with its object. */
class Block extends Handle {
  constructor(gnomon, bytes) {
    super(gnomon, 'free', gnomon.memory.exports.malloc(bytes));
  }
}

/** Resident pages. What the module needs of them lives as long as the object. */
export class PagePlan extends Block {
  take(omissions) {
    const { memory } = this.gnomon;
    const at = this.place();
    const { omissionRoom, omissionCount, pageCount, tableCount, ...plan } = memory.read('page_plan', at);
    Object.assign(this, plan, { pageCount });
    this.omitted = Array.from({ length: Math.min(omissionCount, omissionRoom) }, (_, i) => this.gnomon.readOmission(memory, omissions + i * structs.omission.bytes));
    // They lie in memory of the call.
    memory.pointer('page_plan', at, 'omissions', 0);
    memory.integer('page_plan', at, 'omission_room', 0);
    return this;
  }
  dispose() {
    if (this.gnomon.searches.plan === this) throw new GnomonError('page_plan', 'gnomon: page_plan: not to be disposed by a search for its error');
    super.dispose();
  }
  /** A list that the plan points to, copied. */
  list(field, kind, count) {
    const { memory } = this.gnomon;
    return memory.copy(memory.value('page_plan', this.place(), field), kind, count);
  }
  get pages() {
    if (this.cached === undefined) {
      const flat = this.list('pages', 'i32', 5 * this.pageCount);
      this.cached = Array.from({ length: this.pageCount }, (_, i) => {
        const [level, column, row, slot, points] = flat.subarray(5 * i, 5 * i + 5);
        return { level, column, row, slot, points };
      });
    }
    return this.cached;
  }
  get table() {
    return this.list('table', 'u32', this.gnomon.memory.value('page_plan', this.place(), 'table_count'));
  }
  level(index) {
    return this.mapOf('gnomon_page_level', wholeOf(index, 'level'));
  }
  map(page) {
    return this.mapOf('gnomon_page_map', BigInt(wholeOf(page, 'page')));
  }
  mapOf(call, index) {
    return this.gnomon.call(structs.map.bytes, (memory, check) => {
      const at = memory.struct('map');
      check((field) => memory.exports[call](this.place(), index, at, field));
      return memory.read('map', at);
    });
  }
  select(points) {
    const flat = pointsOf(points, 'points');
    const count = flat.length / 3;
    return this.gnomon.call(flat.length * 8 + count * 4, (memory, check) => {
      const at = memory.numbers(flat);
      const indices = memory.allocate(count * 4);
      check((field) => memory.exports.gnomon_page_select(this.place(), at, BigInt(count), indices, field));
      return memory.copy(indices, 'i32', count);
    });
  }
  measure({ grid = {}, ...view }) {
    const { ready, bytes } = this.gnomon.prepare(view);
    return this.gnomon.call(bytes, (memory, check) => {
      const at = this.gnomon.writeInput(memory, ready);
      const options = memory.struct('measure_options');
      memory.write('measure_options', options, grid);
      const stats = memory.struct('stats');
      const texels = memory.allocate(8);
      check((field) => memory.exports.gnomon_measure_pages(this.place(), at.view, at.scene, options, stats, texels, field));
      return { ...memory.read('stats', stats), texelsPerPixel: memory.view.getFloat64(texels, true) };
    });
  }
}

export function planPages(gnomon, { options = {}, history = {}, ...view }) {
  const { ready, bytes } = gnomon.prepare(view);
  const { memory } = gnomon;
  const { plan: planOptions, ...pageOptions } = options;
  const points = pointCount(ready);
  const capacity = wholeOf(options.capacity ?? 4096, 'page_options.capacity');
  const room = Number(memory.exports.gnomon_page_memory(capacity, BigInt(points)));
  if (room === 0) throw new GnomonError('page_options.capacity');
  const feedback = history.feedback === undefined ? [] : numbersOf(history.feedback, 'page_history.feedback');
  const result = new PagePlan(gnomon, PLAN + room);
  try {
    return gnomon.call(bytes + feedback.length + constants.MAX_OMISSIONS * structs.omission.bytes, (_, check) => {
      const at = gnomon.writeInput(memory, ready);
      if (at.light === undefined) throw new GnomonError('light');
      const how = memory.struct('page_options');
      memory.write('page_options', how, pageOptions);
      if (planOptions !== undefined) {
        const of = memory.struct('plan_options');
        gnomon.writeOptions(memory, of, planOptions);
        memory.pointer('page_options', how, 'plan', of);
      }
      const past = memory.struct('page_history');
      if (history.last !== undefined) memory.pointer('page_history', past, 'last', gnomon.placeOf(history.last, PagePlan, 'page_history.last'));
      if (feedback.length > 0) {
        memory.pointer('page_history', past, 'feedback', memory.numbers(feedback, 'u8'));
        memory.integer('page_history', past, 'feedback_count', feedback.length);
      }
      const plan = memory.struct('page_plan', result.place());
      const omissions = memory.allocate(constants.MAX_OMISSIONS * structs.omission.bytes);
      memory.pointer('page_plan', plan, 'omissions', omissions);
      memory.integer('page_plan', plan, 'omission_room', constants.MAX_OMISSIONS);
      check((field) => memory.exports.gnomon_plan_pages(at.view, at.light, at.scene, how, past, plan + PLAN, BigInt(room), plan, field));
      return result.take(omissions);
    });
  } catch (error) {
    result.dispose();
    throw error;
  }
}

/** Slots that keep pages from frame to frame. */
export class PagePool extends Block {
  constructor(gnomon, slots) {
    const table = Number(gnomon.memory.exports.gnomon_page_table_size(wholeOf(slots, 'slots')));
    if (table === 0) throw new GnomonError('slots');
    super(gnomon, slots * structs.page_slot.bytes + 4 * table);
    this.slots = slots;
    this.clear();
  }
  clear() {
    this.gnomon.memory.clear(this.place(), this.slots * structs.page_slot.bytes);
  }
  keep(plan, moved = []) {
    const boxes = boxesOf(moved, 'moved');
    const at = this.gnomon.placeOf(plan, PagePlan, 'page_plan');
    const count = plan.pageCount;
    return this.gnomon.call(boxes.length * 8 + count * structs.kept_page.bytes, (memory, check) => {
      const list = memory.numbers(boxes);
      const kept = memory.allocate(count * structs.kept_page.bytes);
      const drawn = memory.allocate(8);
      const slots = this.place();
      check((field) => memory.exports.gnomon_keep_pages(at, list, BigInt(boxes.length / 6), slots, this.slots, slots + this.slots * structs.page_slot.bytes, kept, drawn, field));
      const bytes = memory.copy(kept, 'u8', count * structs.kept_page.bytes);
      const flags = (offset) => Uint8Array.from({ length: count }, (_, i) => bytes[structs.kept_page.bytes * i + offset]);
      return {
        slots: Uint32Array.from({ length: count }, (_, i) => new DataView(bytes.buffer).getUint32(structs.kept_page.bytes * i, true)),
        draw: flags(structs.kept_page.fields.draw[0]),
        compose: flags(structs.kept_page.fields.compose[0]),
        drawn: Number(memory.view.getBigInt64(drawn, true)),
      };
    });
  }
}
