// Plans in a worker what it is sent, with the module that it is sent.
import { load } from '/node_modules/gnomon/index.js';

self.onmessage = async ({ data: { wasm, input } }) => {
  const gnomon = await load({ wasm });
  self.postMessage(gnomon.plan(input).maps.map(({ clipFromWorld }) => clipFromWorld));
};
