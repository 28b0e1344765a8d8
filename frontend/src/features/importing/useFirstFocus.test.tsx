import { screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { useFirstFocus } from './useFirstFocus';

function Button() {
  return <button ref={useFirstFocus<HTMLButtonElement>()}>Next</button>;
}

it('focuses what has appeared', async () => {
  show(<Button />);
  await waitFor(() => expect(screen.getByRole('button', { name: 'Next' })).toHaveFocus());
});
