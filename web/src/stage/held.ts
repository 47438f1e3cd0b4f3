/** What a hand holds and how hard it presses while it drags a point, whether by pointer or by key. */

export type Held = {
  readonly shift: boolean;
  readonly alt: boolean;
  /** Of a pen, 0 to 1; null where none is in hand. */
  readonly pressure: number | null;
};

export function heldWith(event: MouseEvent | KeyboardEvent): Held {
  const isPen = event instanceof PointerEvent && event.pointerType === 'pen'; // mice and fingers report a half whatever they feel
  return { shift: event.shiftKey, alt: event.altKey, pressure: isPen ? event.pressure : null };
}
