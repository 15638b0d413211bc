// Pages with the installed package in a headless browser, over a server of this folder, of the sample and of the packages.
import { createReadStream, existsSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const TYPES = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
const IMPORTS = {
  three: '/node_modules/three/build/three.module.js',
  'three/addons/': '/node_modules/three/examples/jsm/',
  gnomon: '/node_modules/gnomon/index.js',
  'gnomon/three': '/node_modules/gnomon/three.js',
  'gnomon/babylon': '/node_modules/gnomon/babylon.js',
  '@babylonjs/core/': '/node_modules/@babylonjs/core/',
  'gnomon/playcanvas': '/node_modules/gnomon/playcanvas.js',
  playcanvas: '/node_modules/playcanvas/build/playcanvas.mjs',
  'three-mesh-bvh': '/node_modules/three-mesh-bvh/build/index.module.js',
};
const EMPTY = `<!doctype html><link rel="icon" href="data:,"><script type="importmap">${JSON.stringify({ imports: IMPORTS })}</script><body></body>`;

function serve(consumer, scenes) {
  const samples = join(here, '../../../samples');
  const roots = { node_modules: join(consumer, 'node_modules'), sample: join(samples, 'web'), capture: join(samples, 'capture'), scenes };
  return createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    if (path === '/') {
      response.setHeader('content-type', 'text/html');
      response.end(EMPTY);
      return;
    }
    // The sample has the packages in a folder of its own.
    const [, top, ...rest] = path.replace('/sample/node_modules/', '/node_modules/').split('/');
    const file = top in roots ? join(roots[top], ...rest) : join(here, path);
    if (!existsSync(file)) {
      response.statusCode = 404;
      response.end();
      return;
    }
    response.setHeader('content-type', TYPES[extname(file)] ?? 'application/octet-stream');
    createReadStream(file).pipe(response);
  });
}

/** Opens a page and calls `use(page)`; returns its result, and what the page reported as errors. `/scenes/` is `scenes`. */
export async function onPage(path, consumer, use, { scenes = here, viewport } = {}) {
  const server = serve(consumer, scenes);
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  const { default: puppeteer } = await import(createRequire(join(consumer, 'x.js')).resolve('puppeteer-core'));
  const browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
    protocolTimeout: 7200000,
  });
  try {
    const page = await browser.newPage();
    page.setDefaultTimeout(120000);
    if (viewport !== undefined) await page.setViewport(viewport);
    const errors = [];
    page.on('pageerror', (error) => errors.push(error.message));
    page.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
    await page.goto(`http://127.0.0.1:${server.address().port}${path}`);
    return { result: await use(page), errors };
  } finally {
    await browser.close();
    server.close();
  }
}

/** Runs `run(input)` of a module of this folder in the browser, and returns what it returns. */
export const inBrowser = (script, consumer, input, scenes) =>
  onPage('/', consumer, (page) => page.evaluate(async (module, given) => (await import(module)).run(given), `/${script}`, input), { scenes });
