// The built page in Chromium without a network: it draws, answers, shares, keeps the same bits, and is usable on a phone and by keys.
//
// KONTUR_BROWSER names the browser; without one nothing is tested, and the tests say so.

import { existsSync, mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { type Browser, type BrowserContextOptions, type Page, chromium } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { SAMPLES } from "../app/samples";
import { DEFAULTS, settings } from "../app/settings";
import { toLink } from "../app/share";
import { SIGNALS } from "../app/trace";
import { native } from "./native";

const executablePath = process.env.KONTUR_BROWSER ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => existsSync(path)) ?? "";
const url = new URL("../dist/index.html", import.meta.url).href;
const SQUARE = SAMPLES[0];

describe.skipIf(executablePath === "")("the page", () => {
  let browser: Browser;
  const errors: string[] = [];

  beforeAll(async () => {
    browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
  });
  afterAll(() => browser?.close());

  async function open(hash = "", options: BrowserContextOptions = {}): Promise<Page> {
    const context = await browser.newContext({ offline: true, viewport: { width: 1280, height: 900 }, ...options });
    const page = await context.newPage();
    errors.length = 0;
    page.on("pageerror", (e) => errors.push(e.message));
    page.on("console", (m) => m.type() === "error" && errors.push(m.text()));
    page.on("request", (r) => !/^(file|data|blob):/.test(r.url()) && errors.push(`request of ${r.url()}`));
    await page.goto(url + hash);
    return page;
  }

  /**
   * Waits for the result of what an action asks for, and gives the time from asking to drawing in ms. Without an action it waits for the
   * first result of the page, which may be there already.
   */
  async function drawn(page: Page, action?: () => Promise<unknown>): Promise<number> {
    if (action) {
      await page.evaluate(() => delete document.documentElement.dataset.drawn);
      await action();
    }
    await page.waitForFunction(() => document.documentElement.dataset.drawn !== undefined);
    return Number(await page.evaluate(() => document.documentElement.dataset.drawn));
  }

  const number = async (page: Page, name: string) => Number.parseFloat((await page.locator("#numbers div", { hasText: name }).locator("dd").textContent()) ?? "");
  const write = async (page: Page, text: string) => {
    await page.locator(".cm-content").click();
    await page.keyboard.press("Control+a");
    await page.keyboard.insertText(text);
  };

  test("draws the square again for every control, without a network", async () => {
    const page = await open();
    await page.waitForFunction(() => document.documentElement.dataset.drawn !== undefined);
    const error = await number(page, "Contour error");
    expect(error).toBeGreaterThan(50);
    const times: number[] = [];
    for (const freq of [25, 30, 35, 40, 50, 60, 70, 80, 30, 20]) {
      times.push(await drawn(page, () => page.locator('input[type="range"][name="freq_hz"]').fill(String(freq))));
    }
    times.sort((a, b) => a - b);
    console.log(`control to picture on the square: median ${times[5]} ms, longest ${times[9]} ms`);
    expect(await number(page, "Contour error")).toBeCloseTo(error, 2);
    await drawn(page, () => page.locator('input[name="bounded"]').check());
    expect(await number(page, "Axis deviation")).toBeLessThanOrEqual(10);
    const colours = await page.locator("#contour").evaluate((canvas: HTMLCanvasElement) => {
      const pixels = canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
      const seen = new Set<number>();
      for (let i = 0; i < pixels.length; i += 4) {
        seen.add(((pixels[i] ?? 0) << 16) | ((pixels[i + 1] ?? 0) << 8) | (pixels[i + 2] ?? 0));
      }
      return seen.size;
    });
    expect(colours).toBeGreaterThan(5);
    expect(await page.locator(".uplot").count()).toBe(2);
    expect(errors).toEqual([]);
    await page.context().close();
  });

  test("keeps the bits of the library", async () => {
    const page = await open();
    await drawn(page, () => page.locator('input[type="number"][name="freq_hz"]').fill("33"));
    await page.locator("#same summary").click();
    await expect.poll(() => page.locator("#hash").textContent()).toMatch(/^[0-9a-f]{64}$/);
    const folder = mkdtempSync(join(tmpdir(), "kontur-"));
    const path = join(folder, "square.nc");
    writeFileSync(path, SQUARE?.program ?? "");
    const set = settings({ ...DEFAULTS, ...SQUARE?.controls, freq_hz: 33 }).flatMap((s) => ["--set", s]);
    const expected = native("trace-hash", ["--signals", SIGNALS.join(","), ...set, path]).split(" ")[0];
    expect(await page.locator("#hash").textContent()).toBe(expected);
    await page.context().close();
  });

  test("shows mistakes while they are typed, and what they mean", async () => {
    const page = await open();
    await drawn(page);
    await write(page, "N10 G01 X10\nN20 G777\nM30\n");
    const first = page.locator("#messages li").first();
    await expect.poll(() => first.textContent()).toContain("20008");
    expect(await page.locator(".cm-lintRange-error").count()).toBe(2);
    expect(await page.locator("#notice").textContent()).toContain("was refused");
    await first.locator("button").click();
    await expect.poll(() => page.locator("#detail").textContent()).toContain("first G01/G02/G03 without F");
    await drawn(page, () => write(page, "N10 #VIB GUARD ON [MODE=1 FREQ=20]\nN20 G01 X10 F1000\nM30\n"));
    expect(await page.locator("#notice").isVisible()).toBe(false);
    await page.locator(".cm-line").first().hover({ position: { x: 70, y: 8 } });
    await expect.poll(() => page.locator(".cm-tooltip-hover").textContent()).toContain("FREQ");
    expect(errors).toEqual([]);
    await page.context().close();
  });

  test("stops what never ends, and continues", async () => {
    const page = await open();
    await drawn(page);
    await drawn(page, () => write(page, "$WHILE 1\nG01 X100 F60000\nX0\n$ENDWHILE\nM30\n"));
    expect(await page.locator("#notice").textContent()).toContain("Stopped after 120 s");
    // the page answers while a program runs
    await write(page, "$WHILE 1\nP1=1\n$ENDWHILE\nM30\n");
    await expect.poll(() => page.locator("#messages").textContent()).toContain("K-0017");
    await drawn(page, () => write(page, "G01 X1 F1000\nM30\n"));
    expect(await page.locator("#notice").isVisible()).toBe(false);
    await page.context().close();
  });

  test("shares its state by the link", async () => {
    const link = await toLink({ sample: "lag", program: "G01 X3 Y4 F1000\nM30\n", controls: { ...DEFAULTS, kv_1_s: 123 } });
    const page = await open(`#${link}`);
    await drawn(page);
    expect(await page.locator(".cm-content").textContent()).toContain("X3 Y4");
    expect(await page.locator('input[type="number"][name="kv_1_s"]').inputValue()).toBe("123");
    await page.locator("#share").click();
    await expect.poll(() => page.url()).toContain("#");
    const again = await open(new URL(page.url()).hash);
    await drawn(again);
    expect(await again.locator(".cm-content").textContent()).toBe(await page.locator(".cm-content").textContent());
    await page.context().close();
    await again.context().close();
    const broken = await open("#nonsense");
    await broken.waitForFunction(() => document.documentElement.dataset.drawn !== undefined);
    expect(await broken.locator("#notice").textContent()).toContain("no program");
    await broken.context().close();
  });

  test("says when a goal is reached", async () => {
    const page = await open();
    await drawn(page);
    await drawn(page, () => page.locator("#sample").selectOption("lag"));
    expect(await page.locator("#goal").textContent()).toContain("Not yet");
    await drawn(page, () => page.locator('input[type="number"][name="kv_1_s"]').fill("200"));
    expect(await page.locator("#goal").textContent()).toContain("Reached");
    await page.context().close();
  });

  test.each([["light", 390], ["dark", 390], ["dark", 1280]] as const)("is readable: %s, %i px", async (colorScheme, width) => {
    const page = await open("", { colorScheme, viewport: { width, height: 844 } });
    await drawn(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
    // contrast of every text against what lies behind it, by the formula of WCAG 2
    const poor = await page.evaluate(() => {
      const parse = (colour: string) => (colour.match(/[\d.]+/g) ?? []).map(Number);
      const light = ([r = 0, g = 0, b = 0]: number[]) => {
        const linear = (c: number) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4);
        return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
      };
      const behind = (element: Element): number[] => {
        for (let at: Element | null = element; at; at = at.parentElement) {
          const colour = parse(getComputedStyle(at).backgroundColor);
          if (colour.length === 3 || (colour[3] ?? 0) > 0.9) {
            return colour;
          }
        }
        return [255, 255, 255];
      };
      const found: string[] = [];
      for (const element of document.querySelectorAll("body *")) {
        const text = [...element.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent?.trim());
        if (!text || element.closest(".off, .skip, noscript, option, canvas") || !(element as HTMLElement).offsetParent) {
          continue;
        }
        const [a, b] = [light(parse(getComputedStyle(element).color)), light(behind(element))];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        if (ratio < 4.5) {
          found.push(`${element.tagName} ${element.className} "${element.textContent?.trim().slice(0, 30)}" ${ratio.toFixed(2)}`);
        }
      }
      return found;
    });
    expect(poor).toEqual([]);
    await page.context().close();
  });

  test("every control has a name and is reached by keys", async () => {
    const page = await open();
    await drawn(page);
    const nameless = await page.evaluate(() =>
      [...document.querySelectorAll<HTMLInputElement>("button, select, input, canvas, [tabindex='0']")]
        .filter((e) => !e.getAttribute("aria-label") && !(e.labels && e.labels.length > 0) && !e.textContent?.trim())
        .map((e) => e.outerHTML.slice(0, 80)));
    expect(nameless).toEqual([]);
    const reached = new Set<string>();
    await page.locator("#theme").focus();
    for (let i = 0; i < 60; i++) {
      await page.keyboard.press("Tab");
      const at = await page.evaluate(() => {
        const e = document.activeElement as HTMLInputElement | null;
        return e?.closest(".cm-editor") ? "editor" : e?.id || e?.getAttribute("name") || e?.tagName || "";
      });
      reached.add(at);
      if (at === "editor") {
        await page.keyboard.press("Escape");
      }
    }
    for (const id of ["editor", "guard", "freq_hz", "filter", "slope", "kv_1_s", "reset", "keep", "contour", "upper", "lower"]) {
      expect([...reached]).toContain(id);
    }
    await page.locator("#contour").focus();
    const pixels = () => page.locator("#contour").evaluate((canvas: HTMLCanvasElement) => canvas.toDataURL());
    const before = await pixels();
    await page.keyboard.press("+");
    expect(await pixels()).not.toBe(before);
    await page.context().close();
  });
});
