import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { show } from '../../../../harness/testing';
import { MessageRow } from './MessageRow';
import type { StripMessage } from './messages';

const message = (more: Partial<StripMessage> = {}): StripMessage => ({
  id: 'x',
  kind: 'finished',
  tone: 'error',
  titleKey: 'banner.ended',
  values: {},
  text: 'It broke.',
  hint: 'Press Run.',
  link: null,
  canDismiss: false,
  ...more,
});

describe('MessageRow', () => {
  it('has title, text and hint, and is an alert', () => {
    show(<MessageRow message={message()} />);
    expect(screen.getByRole('alert')).toHaveTextContent('The run ended: It broke. Press Run.');
    expect(screen.queryByRole('button')).toBeNull();
  });

  it('has no alert role if nothing is wrong, and no role in the list', () => {
    const { unmount } = show(<MessageRow message={message({ tone: 'quiet', kind: 'restart' })} />);
    expect(screen.getByRole('status')).toBe(screen.getByTestId('restart-offer'));
    unmount();
    show(<MessageRow isWhole message={message()} />);
    expect(screen.queryByRole('alert')).toBeNull();
    expect(screen.getByTestId('strip-message')).toBeInTheDocument();
  });
});
