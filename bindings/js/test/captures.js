// Shipped captures, and the verdict on one. GNOMON: the program, where it is built; without it, its verdict is not looked at.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../../..');
const program = process.env.GNOMON ?? join(root, 'build/release/bin/gnomon');

export const shipped = (name) => JSON.parse(readFileSync(join(root, 'samples/capture', `${name}.json`), 'utf8'));

/** Numbers within rounding, all else equal. */
export function alike(a, b, path = '') {
  if (typeof b === 'number') return assert.ok(Math.abs(a - b) <= 1e-5 * (1 + Math.abs(b)), `${path}: ${a} and ${b}`);
  if (b === null || typeof b !== 'object') return assert.equal(a, b, path);
  assert.deepEqual(Object.keys(a), Object.keys(b), path);
  for (const key of Object.keys(b)) alike(a[key], b[key], `${path}.${key}`);
}

/** The program takes it; its findings. */
export function judged(capture) {
  if (!existsSync(program)) return undefined;
  const file = join(mkdtempSync(join(tmpdir(), 'capture-')), 'capture.json');
  writeFileSync(file, JSON.stringify(capture));
  const run = spawnSync(program, ['judge', file, '--json'], { encoding: 'utf8' });
  assert.equal(run.status, 0, run.stderr);
  return JSON.parse(run.stdout).findings.map(({ kind }) => kind);
}
