// node agree.mjs PROGRAM.wasm NATIVE: runs both and fails unless they print the same numbers within 1e-6.
import { execFileSync } from 'node:child_process';
import { closeSync, openSync, readFileSync } from 'node:fs';
import { WASI } from 'node:wasi';

const largest_difference = 1e-6;
const [, , program, native] = process.argv;

const printed = `${program}.txt`, stdout = openSync(printed, 'w');
const wasi = new WASI({ version: 'preview1', args: [program], env: {}, stdout, returnOnExit: true });
const module = await WebAssembly.compile(readFileSync(program));
// Exceptions are the caller's to throw (web/src/exceptions.cpp).
const page = { fail() { throw new Error(`${program} threw an exception`); } };
const status = wasi.start(await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi.wasiImport, page }));
closeSync(stdout);
if (status) throw new Error(`${program} ended with ${status}`);

const numbers = (text) => text.trim().split(/\s+/).map(Number);
const ours = numbers(readFileSync(printed, 'utf8')), theirs = numbers(execFileSync(native, { encoding: 'utf8' }));
if (ours.length !== theirs.length || ours.length < 100) throw new Error(`${ours.length} and ${theirs.length} numbers`);
const worst = Math.max(...ours.map((number, i) => Math.abs(number - theirs[i])));
console.log(`${ours.length} numbers, largest difference ${worst}`);
if (!(worst < largest_difference)) process.exit(1);
