import { screen, waitFor } from '@testing-library/react';
import { useRef, useState } from 'react';
import { expect, it } from 'vitest';
import { show, user } from '../../../harness/testing';
import { useKeptFocus } from './useKeptFocus';

function Part() {
  const part = useRef<HTMLDivElement>(null);
  const [mode, setMode] = useState<'first' | 'second' | 'none'>('first');
  useKeptFocus(part);
  return (
    <>
      <button type="button">before</button>
      <div ref={part}>
        <div>
          <button type="button">side</button>
        </div>
        <section>
          {mode === 'first' ? (
            <p>
              <button type="button" onClick={() => setMode('second')}>
                to second
              </button>
              <button type="button" onClick={() => setMode('none')}>
                to none
              </button>
            </p>
          ) : mode === 'second' ? (
            <label>
              field
              <input />
            </label>
          ) : null}
        </section>
      </div>
    </>
  );
}

it('goes to what came in the place of the focused element', async () => {
  show(<Part />);
  await user.click(screen.getByRole('button', { name: 'to second' }));
  await waitFor(() => expect(screen.getByLabelText('field')).toHaveFocus());
});

it('goes outwards where nothing came', async () => {
  show(<Part />);
  await user.click(screen.getByRole('button', { name: 'to none' }));
  await waitFor(() => expect(screen.getByRole('button', { name: 'side' })).toHaveFocus());
});

it('takes no focus that was elsewhere', async () => {
  show(<Part />);
  const other = screen.getByRole('button', { name: 'to second' });
  screen.getByRole('button', { name: 'before' }).focus();
  other.addEventListener('click', () => screen.getByRole('button', { name: 'before' }).focus());
  other.click();
  await screen.findByLabelText('field');
  await Promise.resolve();
  expect(screen.getByRole('button', { name: 'before' })).toHaveFocus();
});
