// `npm run --silent hash -- PROGRAM...`: the output of `trace-hash`, computed by the module.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { traceHash } from "../app/canonical";
import { Engine } from "../app/engine";

const packed = readFileSync(new URL("../app/generated/kontur.wasm.gz", import.meta.url));
const signals = "path,ipo,set,kin,err,ctrl,drive,axis,spindle";
for (const program of process.argv.slice(2)) {
  const engine = await Engine.load(gunzipSync(packed));
  const started = engine.start({ program: readFileSync(program, "utf8"), settings: [], ax_dev_mm: null, signals, max_rows: 1e7 });
  if (started.refused) {
    throw new Error(`${program} is refused: ${JSON.stringify(started.messages)}`);
  }
  while (engine.advance(10_000));
  const columns = started.columns.map((column, i) => ({ name: column.name, values: engine.column(i) }));
  console.log(`${await traceHash(columns)}  ${program}`);
}
