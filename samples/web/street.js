// A street to look at: houses, trees, benches and fences, with shadows near and far.
import * as THREE from 'three';

const geometries = {};
const cached = (key, make) => (geometries[key] ??= make());

/** The street as one group. `materialOf(colour)` gives the materials, so that each light may have its own. */
export function street(materialOf) {
  const group = new THREE.Group();
  const add = (geometry, color, x, y, z) => {
    const mesh = new THREE.Mesh(geometry, materialOf(color));
    mesh.position.set(x, y, z);
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
  };
  const box = (width, height, depth) => cached(`box ${width} ${height} ${depth}`, () => new THREE.BoxGeometry(width, height, depth));
  const trunk = cached('trunk', () => new THREE.CylinderGeometry(0.15, 0.2, 3, 8));
  const crown = cached('crown', () => new THREE.IcosahedronGeometry(1.5, 1));
  add(box(120, 1, 260), 0x8a8d88, 0, -0.5, -100);
  // The same on both sides, so that both halves of the picture show the same shadows.
  for (let i = 0; i < 32; ++i) {
    const side = i % 2 === 0 ? -1 : 1;
    const row = i >> 1;
    const height = 4 + ((row * 7) % 9) + side;
    const z = -15 * row;
    add(box(9, height, 10), [0xc8b49a, 0xb98f76, 0xa9b0b5][i % 3], side * 14, height / 2, z);
    for (let floor = 1; floor < height - 1; floor += 2.4) add(box(0.5, 0.15, 8), 0xe8e4da, side * 9.3, floor + 1, z);
    add(trunk, 0x5b4632, side * 5.5, 1.5, z - 4);
    add(crown, 0x4f7a3a, side * 5.5, 4, z - 4);
    for (let k = 0; k < 9; ++k) add(box(0.08, 1.1, 0.08), 0x333333, side * 3, 0.55, z - k);
    for (const y of [0.5, 1]) add(box(0.06, 0.06, 8), 0x333333, side * 3, y, z - 4);
  }
  return group;
}
