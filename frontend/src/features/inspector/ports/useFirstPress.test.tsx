import { render, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { user } from '../../../../harness/testing';
import { useFirstPress } from './useFirstPress';

function Field() {
  return <input aria-label="speed" defaultValue="0.3" {...useFirstPress()} />;
}

const field = () => screen.getByRole<HTMLInputElement>('textbox', { name: 'speed' });

describe('useFirstPress', () => {
  it('lets typed text replace the old one', async () => {
    render(<Field />);
    await user.click(field());
    await user.keyboard('0.15');
    expect(field()).toHaveValue('0.15');
  });

  it('leaves the caret of the second press where it is', async () => {
    render(<Field />);
    await user.click(field());
    await user.pointer({ target: field(), offset: 3, keys: '[MouseLeft]' });
    await user.keyboard('5');
    expect(field()).toHaveValue('0.35');
  });
});
