// A street of boxes that tests share.
export const boxes = new Float64Array([-40, -1, -200, 40, 0, 20, ...Array.from({ length: 40 }, (_, i) => {
  const x = i % 2 === 0 ? -12 : 8;
  return [x, 0, -5 * i - 3, x + 4, 2 + (i % 7), -5 * i];
}).flat()]);
