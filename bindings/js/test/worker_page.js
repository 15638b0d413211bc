// One plan on the page and one in a worker, which takes the page's compiled module.
import { load } from 'gnomon';
import { boxes } from './street.js';

export async function run() {
  const wasm = await WebAssembly.compileStreaming(fetch('/node_modules/gnomon/gnomon.wasm'));
  const gnomon = await load({ wasm });
  const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, far: 250 });
  const input = { camera, light: { direction: [0.4, -1, 0.3] }, casters: boxes, receivers: boxes };
  const worker = new Worker('/worker.js', { type: 'module' });
  const there = await new Promise((done, failed) => {
    worker.onmessage = ({ data }) => done(data);
    worker.onerror = ({ message }) => failed(new Error(message));
    worker.postMessage({ wasm, input });
  });
  worker.terminate();
  const here = gnomon.plan(input).maps.map(({ clipFromWorld }) => clipFromWorld);
  const times = [['default', {}], ['stable', { fit: 'stable' }]].map(([name, options]) => {
    const set = gnomon.casterSet(boxes);
    const one = () => gnomon.plan({ ...input, casters: set, receivers: set, options });
    for (let i = 0; i < 300; ++i) one();
    // Clocks of browsers are coarse: ten plans at a time.
    const all = Array.from({ length: 40 }, () => {
      const begin = performance.now();
      for (let i = 0; i < 10; ++i) one();
      return (performance.now() - begin) / 10;
    });
    return [name, all.sort((a, b) => a - b)[20]];
  });
  return { here: here.map((m) => [...m]), there: there.map((m) => [...m]), times };
}
