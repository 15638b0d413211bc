// The error m as colours: how many screen pixels a texel covers at what each pixel shows.
import * as THREE from 'three';

const COLUMNS = 128;
const RAMP = [[26, 152, 80], [166, 217, 106], [254, 224, 139], [244, 109, 67], [165, 0, 38]];

/** Green up to one screen pixel per texel, then a step of the ramp for each doubling. */
function colourOf(m) {
  const at = Math.min(RAMP.length - 1.001, Math.max(0, Math.log2(Math.max(m, 1))));
  const [low, high] = [RAMP[Math.floor(at)], RAMP[Math.floor(at) + 1]];
  return low.map((value, i) => value + (at % 1) * (high[i] - value));
}

/** Draws what the camera sees into a small image of places and normals, and colours it by what gnomon measures there. */
export class Heat {
  constructor(gnomon, renderer, canvas) {
    Object.assign(this, { gnomon, renderer, canvas });
    this.material = new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: 'out vec3 place; void main() { vec4 p = modelMatrix * vec4(position, 1.0); place = p.xyz; gl_Position = projectionMatrix * viewMatrix * p; }',
      fragmentShader: `in vec3 place; layout(location = 0) out vec4 a; layout(location = 1) out vec4 b;
        void main() { a = vec4(place, 1.0); b = vec4(normalize(cross(dFdx(place), dFdy(place))), 1.0); }`,
    });
  }

  /** What the image shows: points, normals, view depths, and their pixels. */
  read(scene, camera) {
    const [width, height] = [COLUMNS, Math.max(1, Math.round(COLUMNS / camera.aspect))];
    if (this.target?.height !== height) {
      this.target?.dispose();
      this.target = new THREE.WebGLRenderTarget(width, height, { count: 2, type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter });
    }
    const { renderer, target } = this;
    const { overrideMaterial, background } = scene;
    const colour = renderer.getClearColor(new THREE.Color());
    const alpha = renderer.getClearAlpha();
    Object.assign(scene, { overrideMaterial: this.material, background: null });
    renderer.setScissorTest(false);
    renderer.setClearColor(0, 0);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    renderer.setClearColor(colour, alpha);
    Object.assign(scene, { overrideMaterial, background });
    const [places, normals] = [0, 1].map((i) => {
      const values = new Float32Array(4 * width * height);
      renderer.readRenderTargetPixels(target, 0, 0, width, height, values, undefined, i);
      return values;
    });
    const found = { width, height, points: [], normals: [], depths: [], pixels: [] };
    const place = new THREE.Vector3();
    for (let i = 0; i < width * height; ++i) {
      if (places[4 * i + 3] === 0) continue;
      found.points.push(...places.subarray(4 * i, 4 * i + 3));
      found.normals.push(...normals.subarray(4 * i, 4 * i + 3));
      found.depths.push(-place.fromArray(places, 4 * i).applyMatrix4(camera.matrixWorldInverse).z);
      found.pixels.push(i);
    }
    return found;
  }

  /** Left of `split` (0..1) by the plan `left`, right of it by `right`. */
  draw(scene, camera, seenFrom, split, left, right) {
    const seen = this.read(scene, camera);
    const { canvas, gnomon } = this;
    [canvas.width, canvas.height] = [seen.width, seen.height];
    const context = canvas.getContext('2d');
    const image = context.createImageData(seen.width, seen.height);
    for (const [plan, side] of [[left, 0], [right, 1]]) {
      const chosen = gnomon.select(plan, seen.points, seen.depths);
      plan.maps.forEach((map, index) => {
        const mine = seen.pixels.map((pixel, k) => k).filter((k) => chosen[k] === index && Number((seen.pixels[k] % seen.width) + 0.5 > split * seen.width) === side);
        if (mine.length === 0) return;
        const pick = (from) => mine.flatMap((k) => from.slice(3 * k, 3 * k + 3));
        gnomon.measurePoints(map, { camera: seenFrom, points: pick(seen.points), normals: pick(seen.normals) }).forEach(({ status, mMax }, n) => {
          if (status !== 'ok') return;
          const pixel = seen.pixels[mine[n]];
          const row = seen.height - 1 - Math.floor(pixel / seen.width);
          image.data.set([...colourOf(mMax), 255], 4 * (row * seen.width + (pixel % seen.width)));
        });
      });
    }
    context.putImageData(image, 0, 0);
  }
}
