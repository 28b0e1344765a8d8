import { useEffect, useState, type FormEvent, type KeyboardEvent } from 'react';
import { setTyping } from '@/store/run/livePorts';

const TEXTS = 'input:not([type]), input[type="text"], textarea, [contenteditable="true"]';
const ENDING = new Set(['Enter', 'ArrowUp', 'ArrowDown']);

/**
 * Tracks whether a text is being typed in a port's field. The running program gets the text when the user
 * presses Enter, steps the number, or leaves the field; a choice or a switch counts at once.
 */
export function useTyping() {
  const [isTyping, setIsTyping] = useState(false);
  const say = (now: boolean) => {
    setIsTyping(now);
    setTyping(now);
  };
  useEffect(
    () => () => {
      setTyping(false);
    },
    [],
  );
  const handlers = {
    onInput: ({ target }: FormEvent) => {
      if (target instanceof Element && target.closest(TEXTS)) say(true);
    },
    onKeyDown: ({ key }: KeyboardEvent) => {
      if (ENDING.has(key)) say(false);
    },
    onBlur: () => {
      say(false);
    },
  };
  return { isTyping, handlers };
}
