// The editor: syntax colours of the dialect, messages at their places, the meaning of the word under the pointer.

import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic, lintGutter, lintKeymap, setDiagnostics } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Explained, Message } from "./engine";

/** Words and their kinds, matched at the start of the rest of a line. */
const TOKENS: [RegExp, string][] = [
  [/^;.*/, "comment"],
  [/^\([^)]*\)?/, "comment"],
  [/^"[^"]*"?/, "string"],
  [/^[#$][A-Z]+( (?!ON\b|OFF\b)[A-Z]+)*/i, "keyword"],
  [/^%L?\s*\w*/i, "heading"],
  [/^[GMT]\d+(\.\d+)?/i, "keyword"],
  [/^N\d+/i, "meta"],
  [/^V\.[A-Z]+(\.\w+)*/i, "variableName"],
  [/^(PP?\d+|@P\d+)/i, "variableName"],
  [/^(ON|OFF)\b/i, "atom"],
  [/^(SIN|COS|TAN|ASIN|ACOS|ATAN|SQRT|ABS|EXP|LN|INT|ROUND|MOD)\b/i, "function"],
  [/^[A-Z_]{2,}(?=\s*=)/i, "propertyName"],
  [/^[XYZABCIJKRFSEDLHQUVW](?=[-+.\d[PV=])/i, "typeName"],
  [/^\d+(\.\d*)?|^\.\d+/, "number"],
];

const language = StreamLanguage.define<null>({
  startState: () => null,
  token(stream) {
    if (stream.eatSpace()) {
      return null;
    }
    for (const [form, name] of TOKENS) {
      if (stream.match(form)) {
        return name;
      }
    }
    stream.next();
    return null;
  },
  tokenTable: { function: tags.function(tags.variableName) },
  languageData: { commentTokens: { line: ";" } },
});

const colours = HighlightStyle.define([
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.keyword, color: "var(--code-keyword)", fontWeight: "600" },
  { tag: tags.heading, color: "var(--code-keyword)", fontWeight: "600" },
  { tag: tags.meta, color: "var(--muted)" },
  { tag: tags.variableName, color: "var(--code-variable)" },
  { tag: tags.function(tags.variableName), color: "var(--code-variable)" },
  { tag: tags.atom, color: "var(--code-keyword)" },
  { tag: tags.propertyName, color: "var(--code-key)" },
  { tag: tags.typeName, color: "var(--code-axis)", fontWeight: "600" },
  { tag: tags.number, color: "var(--code-number)" },
]);

const look = EditorView.theme({
  "&": { backgroundColor: "var(--surface)", color: "var(--text)", fontSize: "13.5px", height: "100%" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
  ".cm-gutters": { backgroundColor: "var(--surface)", color: "var(--muted)", border: "none" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--active)" },
  ".cm-cursor": { borderLeftColor: "var(--text)" },
  "&.cm-focused": { outline: "none" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--selection) !important" },
  ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--text)", border: "1px solid var(--line)", borderRadius: "8px", maxWidth: "min(34rem, 90vw)" },
  ".cm-diagnostic": { padding: "6px 10px", fontFamily: "var(--sans)", fontSize: "13px" },
});

/** The thing at a column that `explain` may know: a command with the text after it, a function, a parameter. */
export function thingAt(line: string, column: number): { from: number; to: number; things: string[] } | null {
  for (const found of line.matchAll(/#[^[\];(]*|\$[A-Z]+|P-[A-Z]+-\d+|[GM]\d+|"[^"]*"|\([^)]*\)|[A-Z_.]{3,}/gi)) {
    const from = found.index;
    const word = found[0].trimEnd();
    if (column < from || column > from + word.length || word.startsWith("(") || word.startsWith('"')) {
      continue;
    }
    const number = word.match(/^([GM])0*(\d+)$/i);
    const things = number ? [word, `${number[1]}${number[2]}`, `${number[1]}0${number[2]}`] : [word];
    // a key belongs to the command before its bracket
    const command = line.slice(0, from).match(/#[^[\];(]*(?=\[[^\]]*$)/);
    return { from, to: from + word.length, things: command && !word.startsWith("#") ? [command[0].trimEnd(), ...things] : things };
  }
  return null;
}

export function explanation(explained: Explained): HTMLElement {
  const make = (name: string, text: string, parent: HTMLElement) => {
    const element = document.createElement(name);
    element.textContent = text;
    parent.append(element);
    return element;
  };
  const box = document.createElement("div");
  box.className = "explained";
  make("strong", explained.title, box);
  if (explained.found) {
    make("p", explained.meaning, box);
    const list = document.createElement("dl");
    for (const [name, fact] of explained.facts) {
      make("dt", name, list);
      make("dd", fact, list);
    }
    if (explained.facts.length > 0) {
      box.append(list);
    }
    explained.notes.forEach((note) => make("p", note, box));
    if (explained.example) {
      make("code", explained.example, box);
    }
  } else {
    make("p", "No explanation available.", box);
  }
  return box;
}

export interface EditorHooks {
  changed(text: string): void;
  line(line: number): void;
  explain(thing: string): Promise<Explained | null>;
}

export class Editor {
  private readonly view: EditorView;
  /** True while the text is replaced from outside. */
  private quiet = false;

  constructor(parent: HTMLElement, text: string, hooks: EditorHooks) {
    const hover = hoverTooltip(async (view, position) => {
      const line = view.state.doc.lineAt(position);
      const thing = thingAt(line.text, position - line.from);
      for (const name of thing?.things ?? []) {
        const explained = await hooks.explain(name);
        if (thing && explained?.found) {
          return { pos: line.from + thing.from, end: line.from + thing.to, create: () => ({ dom: explanation(explained) }) };
        }
      }
      return null;
    });
    const listener = EditorView.updateListener.of((update) => {
      if (update.docChanged && !this.quiet) {
        hooks.changed(update.state.doc.toString());
      }
      if (update.selectionSet || update.docChanged) {
        hooks.line(update.state.doc.lineAt(update.state.selection.main.head).number);
      }
    });
    const state = EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), highlightActiveLineGutter(), highlightActiveLine(), history(), drawSelection(), lintGutter(), hover, listener, look, language,
        syntaxHighlighting(colours),
        keymap.of([...defaultKeymap, ...historyKeymap, ...lintKeymap, indentWithTab]),
        EditorView.contentAttributes.of({ "aria-label": "NC program. Escape, then Tab leaves the editor.", autocapitalize: "off", spellcheck: "false" }),
      ],
    });
    this.view = new EditorView({ state, parent });
  }

  set text(text: string) {
    this.quiet = true;
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text } });
    this.quiet = false;
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  show(messages: Message[]): void {
    const doc = this.view.state.doc;
    const found: Diagnostic[] = [];
    for (const message of messages) {
      if (!message.place || message.place.line > doc.lines) {
        continue;
      }
      const line = doc.line(message.place.line);
      // columns count characters, the editor counts UTF-16
      const at = (column: number) => Math.min(line.to, line.from + Array.from(line.text).slice(0, column).join("").length);
      const from = at(message.place.column - 1);
      const to = at(message.place.column - 1 + message.place.length);
      const text = message.hint ? `${message.text}\n${message.hint}` : message.text;
      const severity = message.severity === "note" ? "info" : message.severity;
      found.push({ from, to: Math.max(from, to), severity, source: message.id, message: text });
    }
    this.view.dispatch(setDiagnostics(this.view.state, found));
  }

  goTo(line: number, column = 1): void {
    const doc = this.view.state.doc;
    const place = doc.line(Math.min(Math.max(line, 1), doc.lines));
    this.view.dispatch({ selection: { anchor: Math.min(place.to, place.from + column - 1) }, scrollIntoView: true });
  }

  focus(): void {
    this.view.focus();
  }
}
