// The canonical form of columns: for each of them its name in UTF-8, a zero byte, and its values as little-endian f64. Its SHA-256
// is the same wherever the same program runs.

export async function traceHash(columns: { name: string; values: Float64Array }[]): Promise<string> {
  const parts = columns.flatMap(({ name, values }) => {
    const bytes = new Uint8Array(values.length * 8);
    const view = new DataView(bytes.buffer);
    values.forEach((value, i) => view.setFloat64(8 * i, value, true));
    return [new TextEncoder().encode(`${name}\0`), bytes];
  });
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", all));
  return Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
}
