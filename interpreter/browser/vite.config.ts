import { defineConfig } from "vitest/config";
import { viteSingleFile } from "vite-plugin-singlefile";

// One file that works offline: script, style, worker and module are inside the page.
export default defineConfig({
  root: "app",
  base: "./",
  assetsInclude: ["**/*.gz"],
  plugins: [viteSingleFile()],
  // programs/lessons is their only source
  server: { fs: { allow: ["../../.."] } },
  build: { outDir: "../dist", emptyOutDir: true, assetsInlineLimit: 1 << 26, chunkSizeWarningLimit: 1 << 14, target: "es2022" },
  // a worker of modules may not start from a file
  worker: { format: "iife" },
  test: { root: ".", include: ["test/**/*.test.ts"], globalSetup: ["test/native.ts"], testTimeout: 120_000, hookTimeout: 120_000, fileParallelism: false },
});
