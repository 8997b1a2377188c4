// Compiles the library and puts it, compressed, where the page takes it from.
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

const own = new URL("..", import.meta.url);
const root = new URL("../..", own);
const target = "wasm32-unknown-unknown";
const profile = "page";
const words = ["build", "--package", "kontur-browser", "--target", target, "--profile", profile];
execFileSync("cargo", words, { cwd: root, stdio: "inherit" });

const metadata = execFileSync("cargo", ["metadata", "--no-deps", "--format-version", "1"], { cwd: root, maxBuffer: 1 << 28 });
const folder = JSON.parse(metadata.toString()).target_directory;
const module = readFileSync(`${folder}/${target}/${profile}/kontur_browser.wasm`);
const packed = gzipSync(module, { level: 9 });
mkdirSync(new URL("app/generated", own), { recursive: true });
writeFileSync(new URL("app/generated/kontur.wasm.gz", own), packed);
console.log(`kontur.wasm: ${(module.length / 1e3).toFixed(0)} kB, ${(packed.length / 1e3).toFixed(0)} kB compressed`);
