import { useLayoutEffect, useRef, useState } from 'react';
import { useUnsaved } from '@/store/saving/useUnsaved';
import classes from './Block.module.css';

interface TextFieldProps {
  readonly label: string;
  readonly initial: string;
  readonly onFinish: (text: string) => void;
}

/** A text field on a block: Enter or leaving the field saves the text, Escape discards it. */
export function TextField({ label, initial, onFinish }: TextFieldProps) {
  const field = useRef<HTMLInputElement>(null);
  const [isTyped, setTyped] = useState(false);
  useUnsaved(isTyped);
  useLayoutEffect(() => {
    field.current?.focus({ preventScroll: true });
    field.current?.select();
  }, []);
  return (
    <input
      ref={field}
      className={`${classes['rename']} nodrag nopan`}
      aria-label={label}
      placeholder={label}
      defaultValue={initial}
      onChange={(event) => setTyped(event.currentTarget.value !== initial)}
      onBlur={(event) => {
        onFinish(event.currentTarget.value);
      }}
      onKeyDown={(event) => {
        event.stopPropagation();
        if (event.key !== 'Enter' && event.key !== 'Escape') return;
        const input = event.currentTarget;
        if (event.key === 'Escape') input.value = initial;
        // The edit is finished, so the canvas gets the keyboard focus again.
        input.closest<HTMLElement>('[data-testid="canvas"]')?.focus({ preventScroll: true });
      }}
    />
  );
}
