// Builds what the page is compared with, once and before any test; after `cargo test --workspace` all of it is there.
import { execFileSync } from "node:child_process";

const root = new URL("../../../", import.meta.url);

export function setup(): void {
  execFileSync("cargo", ["build", "--quiet", "--profile", "test", "--workspace", "--bins", "--examples"], { cwd: root, stdio: "inherit" });
}

/** A program of the profile of the tests: what it prints, or its messages if it fails. */
export function native(program: "trace-hash" | "kontur", words: string[]): string {
  const metadata = execFileSync("cargo", ["metadata", "--no-deps", "--format-version", "1"], { cwd: root, maxBuffer: 1 << 28 });
  const { target_directory: folder } = JSON.parse(metadata.toString()) as { target_directory: string };
  try {
    return execFileSync(`${folder}/debug/${program}`, words, { cwd: root, stdio: "pipe" }).toString();
  } catch (e) {
    return (e as { stderr: Buffer }).stderr.toString();
  }
}
