// node agree.mjs PROGRAM.wasm NATIVE: runs both and fails unless they print the same numbers within 1e-6.
import { execFileSync, spawnSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

const largest_difference = 1e-6;
const [, script, program, native] = process.argv;

if (native) {
  const flags = ['--no-warnings', '--experimental-wasi-unstable-preview1'];
  const there = spawnSync(process.execPath, [...flags, script, program], { encoding: 'utf8' });
  process.stderr.write(there.stderr);
  if (there.status !== 0) throw new Error(`${program} ended with ${there.status}`);
  const numbers = (text) => text.trim().split(/\s+/).map(Number);
  const ours = numbers(there.stdout), theirs = numbers(execFileSync(native, { encoding: 'utf8' }));
  if (ours.length !== theirs.length || ours.length < 100) throw new Error(`${ours.length} and ${theirs.length} numbers`);
  const worst = Math.max(...ours.map((number, i) => Math.abs(number - theirs[i])));
  console.log(`${ours.length} numbers, largest difference ${worst}`);
  if (!(worst < largest_difference)) process.exit(1);
} else {
  const wasi = new WASI({ version: 'preview1', args: [program], env: {} });
  const module = await WebAssembly.compile(readFileSync(program));
  wasi.start(await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi.wasiImport }));
}
