import { hasWebGl } from '@/features/viewer/webgl';
import { cancellable } from '@/ui/cancellable';
import type { Editor, Placing } from './editing';

/** A smaller movement counts as a click, since hands tremble. */
const DEAD_ZONE_PX = 6;

/** A thing that a button or a menu of the palette places. */
export interface Choice extends Placing {
  /** Places the thing without a ghost, at its default place. */
  readonly place: () => void;
}

function begin(editor: Editor, { name, what }: Choice): void {
  editor.store.setState({ placing: { name, what }, tool: 'select' });
}

function giveUp(editor: Editor): void {
  editor.store.setState({ placing: null });
}

/**
 * Makes the ghost of a thing follow the pointer until the thing is placed; choosing the same thing again
 * cancels this. Without a 3D view, the thing is placed at once.
 */
export function choose(editor: Editor, choice: Choice): void {
  const { placer, store } = editor;
  if (!placer && !hasWebGl()) choice.place();
  else if (store.getState().placing?.name === choice.name) giveUp(editor);
  else {
    begin(editor, choice);
    placer?.focus();
  }
}

/** Drags the ghost of a thing from its button into the view, where it is placed when the pointer is released. */
export function dragFrom(button: Element, event: PointerEvent, editor: Editor, choice: Choice): void {
  const { placer } = editor;
  if (!placer || event.button !== 0 || event.pointerType === 'touch') return;
  let isOut = false;
  cancellable(button, event.pointerId, {
    onMove: (move) => {
      const away = Math.hypot(move.clientX - event.clientX, move.clientY - event.clientY);
      if (!isOut && away < DEAD_ZONE_PX) return;
      if (!isOut) begin(editor, choice);
      isOut = true;
      placer.aim(move);
    },
    onEnd: (up) => {
      if (!isOut) return;
      const target = up.target instanceof Node ? up.target : null;
      // Releasing the pointer on the button is a click, which cancels placing.
      if (button.contains(target)) return;
      const isOnPalette = button.closest('[role="toolbar"]')?.contains(target) ?? false;
      if (isOnPalette || !placer.aim(up)) giveUp(editor);
      else {
        placer.put(up.shiftKey);
        placer.focus();
      }
    },
    onCancel: () => giveUp(editor),
  });
}
