// The contour in the plane of X and Y: programmed, set and actual path, zoomed and moved by pointer, wheel and keys.

import { type Trace } from "./trace";

interface View {
  /** Pixels per mm. */
  scale: number;
  /** Centre in mm. */
  x: number;
  y: number;
}

export interface ContourHooks {
  /** The row under the pointer. */
  row(row: number | null): void;
  picked(line: number): void;
}

export class Contour {
  private trace: Trace | undefined;
  private kept: Trace | undefined;
  private view: View | undefined;
  private row: number | null = null;
  private line = 0;
  private showActual = true;
  private readonly pointers = new Map<number, { x: number; y: number }>();
  private moved = 0;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly hooks: ContourHooks) {
    canvas.addEventListener("wheel", (e) => {
      e.preventDefault();
      this.zoom(Math.exp(-e.deltaY * 0.0015), e.offsetX, e.offsetY);
    }, { passive: false });
    canvas.addEventListener("pointerdown", (e) => {
      canvas.setPointerCapture(e.pointerId);
      this.pointers.set(e.pointerId, { x: e.offsetX, y: e.offsetY });
      this.moved = 0;
    });
    canvas.addEventListener("pointermove", (e) => this.move(e));
    const release = (e: PointerEvent) => {
      if (this.pointers.delete(e.pointerId) && this.moved < 4 && e.type === "pointerup" && this.row !== null && this.trace) {
        this.hooks.picked(this.trace.lines[this.row] ?? 0);
      }
    };
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("pointerleave", () => this.hooks.row(null));
    canvas.addEventListener("dblclick", () => this.fit());
    canvas.addEventListener("keydown", (e) => this.key(e));
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  show(trace: Trace): void {
    const first = this.trace === undefined;
    this.trace = trace;
    this.row = null;
    if (first) {
      this.fit();
    } else {
      this.draw();
    }
  }

  /** The next run is shown as a whole. */
  forget(): void {
    this.trace = undefined;
    this.view = undefined;
  }

  keep(trace: Trace | undefined): void {
    this.kept = trace;
    this.draw();
  }

  cursor(row: number | null): void {
    this.row = row;
    this.draw();
  }

  /** The line whose part of the path is highlighted. */
  mark(line: number): void {
    if (line !== this.line) {
      this.line = line;
      this.draw();
    }
  }

  actual(shown: boolean): void {
    this.showActual = shown;
    this.draw();
  }

  /** Shows the whole path. */
  fit(): void {
    const { trace, canvas } = this;
    if (!trace || canvas.clientWidth === 0) {
      this.view = undefined;
      return;
    }
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const [xs, ys] of [[trace.of("X_ipo_mm"), trace.of("Y_ipo_mm")], [trace.of("X_set_mm"), trace.of("Y_set_mm")]] as const) {
      xs.forEach((x) => { left = Math.min(left, x); right = Math.max(right, x); });
      ys.forEach((y) => { low = Math.min(low, y); high = Math.max(high, y); });
    }
    if (!Number.isFinite(left + right + low + high)) {
      return;
    }
    const room = 0.86;
    const scale = Math.min((room * canvas.clientWidth) / Math.max(right - left, 1e-3), (room * canvas.clientHeight) / Math.max(high - low, 1e-3));
    this.view = { scale, x: (left + right) / 2, y: (low + high) / 2 };
    this.draw();
  }

  zoom(factor: number, atX = this.canvas.clientWidth / 2, atY = this.canvas.clientHeight / 2): void {
    const { view, canvas } = this;
    if (!view) {
      return;
    }
    const scale = Math.min(1e6, Math.max(0.01, view.scale * factor));
    const [dx, dy] = [atX - canvas.clientWidth / 2, canvas.clientHeight / 2 - atY];
    view.x += dx / view.scale - dx / scale;
    view.y += dy / view.scale - dy / scale;
    view.scale = scale;
    this.draw();
  }

  private pan(dx: number, dy: number): void {
    if (this.view) {
      this.view.x -= dx / this.view.scale;
      this.view.y += dy / this.view.scale;
      this.draw();
    }
  }

  private key(e: KeyboardEvent): void {
    const step = 40;
    const moves: Record<string, () => void> = {
      "+": () => this.zoom(1.25), "=": () => this.zoom(1.25), "-": () => this.zoom(0.8), "0": () => this.fit(),
      ArrowLeft: () => this.pan(step, 0), ArrowRight: () => this.pan(-step, 0), ArrowUp: () => this.pan(0, step), ArrowDown: () => this.pan(0, -step),
    };
    const act = moves[e.key];
    if (act && !e.ctrlKey && !e.metaKey && !e.altKey) {
      e.preventDefault();
      act();
    }
  }

  private move(e: PointerEvent): void {
    const before = this.pointers.get(e.pointerId);
    if (!before) {
      this.point(e.offsetX, e.offsetY);
      return;
    }
    const [first, second] = [...this.pointers.values()];
    const apart = () => (first && second ? Math.hypot(first.x - second.x, first.y - second.y) : 0);
    const distance = apart();
    this.moved += Math.abs(e.offsetX - before.x) + Math.abs(e.offsetY - before.y);
    this.pan((e.offsetX - before.x) / this.pointers.size, (e.offsetY - before.y) / this.pointers.size);
    before.x = e.offsetX;
    before.y = e.offsetY;
    if (first && second && distance > 0) {
      this.zoom(apart() / distance, (first.x + second.x) / 2, (first.y + second.y) / 2);
    }
  }

  /** Finds the set point nearest to the pointer, within some pixels. */
  private point(px: number, py: number): void {
    const { trace, view, canvas } = this;
    if (!trace || !view) {
      return;
    }
    const [x, y] = [view.x + (px - canvas.clientWidth / 2) / view.scale, view.y + (canvas.clientHeight / 2 - py) / view.scale];
    const [xs, ys] = [trace.of("X_set_mm"), trace.of("Y_set_mm")];
    let best = 24 / view.scale;
    let row: number | null = null;
    for (let i = 0; i < xs.length; i++) {
      const d = Math.hypot((xs[i] ?? 0) - x, (ys[i] ?? 0) - y);
      if (d < best) {
        best = d;
        row = i;
      }
    }
    this.hooks.row(row);
  }

  draw(): void {
    const { canvas, trace } = this;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (width === 0) {
      return;
    }
    if (trace && !this.view) {
      this.fit();
      return;
    }
    const ratio = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const c = canvas.getContext("2d");
    const view = this.view;
    if (!c || !view || !trace) {
      return;
    }
    const style = getComputedStyle(canvas);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    const toX = (x: number) => width / 2 + (x - view.x) * view.scale;
    const toY = (y: number) => height / 2 - (y - view.y) * view.scale;
    this.grid(c, width, height, view, colour);
    const path = (xs: Float64Array, ys: Float64Array, from = 0, to = xs.length) => {
      c.beginPath();
      let [lastX, lastY] = [NaN, NaN];
      for (let i = from; i < to; i++) {
        const [x, y] = [toX(xs[i] ?? 0), toY(ys[i] ?? 0)];
        // steps below a fifth of a pixel are invisible
        if (Math.abs(x - lastX) + Math.abs(y - lastY) < 0.2 && i + 1 < to) {
          continue;
        }
        if (Number.isNaN(lastX)) {
          c.moveTo(x, y);
        } else {
          c.lineTo(x, y);
        }
        [lastX, lastY] = [x, y];
      }
      c.stroke();
    };
    c.lineJoin = "round";
    c.lineCap = "round";
    const stroke = (name: string, wide: number, dash: number[] = []) => {
      c.strokeStyle = colour(name);
      c.lineWidth = wide;
      c.setLineDash(dash);
    };
    const [ipoX, ipoY, setX, setY] = [trace.of("X_ipo_mm"), trace.of("Y_ipo_mm"), trace.of("X_set_mm"), trace.of("Y_set_mm")];
    stroke("--marked", 9);
    for (let i = 0; i < trace.rows; i++) {
      if (trace.lines[i] === this.line) {
        let end = i;
        while (end < trace.rows && trace.lines[end] === this.line) {
          end++;
        }
        path(ipoX, ipoY, Math.max(0, i - 1), end);
        i = end;
      }
    }
    stroke("--programmed", 4);
    path(ipoX, ipoY);
    if (this.kept) {
      stroke("--kept", 1.5, [6, 4]);
      path(this.kept.of("X_set_mm"), this.kept.of("Y_set_mm"));
    }
    if (this.showActual) {
      stroke("--actual", 1.2);
      path(trace.of("X_act_mm"), trace.of("Y_act_mm"));
    }
    stroke("--set", 1.8);
    path(setX, setY);
    if (this.row !== null && this.row < trace.rows) {
      c.fillStyle = colour("--set");
      c.strokeStyle = colour("--surface");
      c.setLineDash([]);
      c.lineWidth = 2;
      c.beginPath();
      c.arc(toX(setX[this.row] ?? 0), toY(setY[this.row] ?? 0), 5, 0, 2 * Math.PI);
      c.fill();
      c.stroke();
    }
  }

  private grid(c: CanvasRenderingContext2D, width: number, height: number, view: View, colour: (name: string) => string): void {
    const rough = 80 / view.scale;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = ([1, 2, 5, 10].find((n) => n * power >= rough) ?? 10) * power;
    const digits = Math.max(0, -Math.floor(Math.log10(step)));
    c.strokeStyle = colour("--grid");
    c.fillStyle = colour("--muted");
    c.lineWidth = 1;
    c.setLineDash([]);
    c.font = `11px ${getComputedStyle(this.canvas).fontFamily}`;
    const first = (centre: number, half: number) => Math.ceil((centre - half) / step);
    for (let i = first(view.x, width / 2 / view.scale); ; i++) {
      const px = Math.round(width / 2 + (i * step - view.x) * view.scale) + 0.5;
      if (px > width) {
        break;
      }
      c.beginPath();
      c.moveTo(px, 0);
      c.lineTo(px, height);
      c.stroke();
      if (px > 34 && px < width - 96) {
        c.fillText((i * step).toFixed(digits), px + 4, height - 6);
      }
    }
    for (let i = first(view.y, height / 2 / view.scale); ; i++) {
      const py = Math.round(height / 2 - (i * step - view.y) * view.scale) + 0.5;
      if (py < 0) {
        break;
      }
      c.beginPath();
      c.moveTo(0, py);
      c.lineTo(width, py);
      c.stroke();
      if (py > 30 && py < height - 20) {
        c.fillText((i * step).toFixed(digits), 4, py - 4);
      }
    }
    c.fillStyle = colour("--text");
    c.fillText("Y in mm", 4, 14);
    c.textAlign = "right";
    c.fillText("X in mm", width - 6, height - 6);
    c.textAlign = "left";
  }
}
