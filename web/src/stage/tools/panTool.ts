/** The hand: the portrait follows the pointer. */
import { subtract } from '../../face/vector';
import { panBy, type Size } from '../view';
import { NOTHING, type Tool } from './gesture';

export function panTool(portrait: () => Size): Tool {
  return {
    aim: () => ({ kind: 'canvas' }),
    drag: (_target, { view }, from, to) => ({ kind: 'look', view: panBy(view, subtract(to.screen, from.screen), portrait()) }),
    click: () => NOTHING,
    reset: () => NOTHING,
    hint: () => 'Drag to move the portrait',
  };
}
