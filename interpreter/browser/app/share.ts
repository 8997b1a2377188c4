// The state of the page as the part of a link after `#`: JSON, deflated, base64url.

import { type Controls, controlsOf } from "./settings";

export interface State {
  /** The sample or exercise that it started from. */
  sample: string;
  program: string;
  controls: Controls;
}

/** Longest program of a link in characters. */
export const PROGRAM_MAX = 1_000_000;

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream, most: number): Promise<Uint8Array<ArrayBuffer>> {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) {
      break;
    }
    length += value.length;
    // small data may inflate to any size
    if (length > most) {
      await reader.cancel();
      throw new Error("the link contains more than a program");
    }
    parts.push(value);
  }
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

export async function toLink(state: State): Promise<string> {
  const text = new TextEncoder().encode(JSON.stringify({ v: 1, s: state.sample, p: state.program, c: state.controls }));
  const packed = await through(text, new CompressionStream("deflate-raw"), Infinity);
  let binary = "";
  for (const byte of packed) {
    binary += String.fromCharCode(byte);
  }
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The state in a link; null if it contains none. */
export async function fromLink(link: string): Promise<State | null> {
  try {
    const binary = atob(link.replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(binary, (c) => c.charCodeAt(0));
    const bytes = await through(packed, new DecompressionStream("deflate-raw"), 4 * PROGRAM_MAX);
    const state = JSON.parse(new TextDecoder().decode(bytes)) as Record<string, unknown>;
    if (typeof state.p !== "string" || state.p.length > PROGRAM_MAX) {
      return null;
    }
    return { sample: typeof state.s === "string" ? state.s : "", program: state.p, controls: controlsOf(state.c) };
  } catch {
    return null;
  }
}
