/** Animation frames whose work sees what was changed in the same frame: the picture is no frame behind the sound. */

let waiting: Set<() => void> | null = null;

/** Does `work` before the next paint, and after it what it asked for by `beforePaint`. Returns what cancels it. */
export function inFrame(work: () => void): () => void {
  const request = requestAnimationFrame(() => {
    const asked = new Set<() => void>();
    waiting = asked;
    try {
      work();
    } finally {
      waiting = null;
    }
    for (const draw of asked) draw();
  });
  return () => cancelAnimationFrame(request);
}

/** Calls `draw` before the next paint: within a frame this one, outside the next. Returns what cancels it. */
export function beforePaint(draw: () => void): () => void {
  const asked = waiting;
  if (!asked) {
    const request = requestAnimationFrame(draw);
    return () => cancelAnimationFrame(request);
  }
  asked.add(draw);
  return () => asked.delete(draw);
}
