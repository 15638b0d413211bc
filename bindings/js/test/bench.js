// How long does a plan take? Median and least of many, microseconds: node test/bench.js [scalar]
import { load } from '../index.js';
import { boxes } from './street.js';

const gnomon = await load({ simd: process.argv[2] !== 'scalar' });
const camera = gnomon.perspective({ position: [0, 3, 10], forward: [0, -0.1, -1], fovY: 1, aspect: 1.5, near: 0.2, far: 250, width: 960, height: 640 });
const set = gnomon.casterSet(boxes);
for (const [name, options] of [['default', {}], ['no warp', { warp: 'none' }], ['stable', { fit: 'stable' }]]) {
  const times = [];
  for (let i = 0; i < 3000; ++i) {
    const begin = process.hrtime.bigint();
    gnomon.plan({ camera, light: { direction: [0.4, -1, 0.3] }, casters: set, receivers: set, options });
    times.push(Number(process.hrtime.bigint() - begin) / 1000);
  }
  times.sort((a, b) => a - b);
  console.log(`${name}: median ${times[1500].toFixed(0)} us, least ${times[0].toFixed(0)} us`);
}
