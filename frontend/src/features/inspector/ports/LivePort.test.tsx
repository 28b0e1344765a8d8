import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import type { PortSpec } from '@/model/ports';
import type { PortMark } from '@/store/run/portMarks';
import { openSession, port, show, user } from '../../../../harness/testing';
import { LivePort } from './LivePort';

const onKeep = vi.fn();
const onBack = vi.fn();
const open = (mark: PortMark | undefined, more: { default?: string; isTyping?: boolean } = {}) =>
  show(
    <LivePort
      port={port('speed', 'double', { default: more.default ?? null }) as PortSpec}
      mark={mark}
      isTyping={more.isTyping ?? false}
      onKeep={onKeep}
      onBack={onBack}
    />,
  );

it('is nothing for a port with its saved value', () => {
  open(undefined, { isTyping: true });
  expect(screen.queryByRole('status')).toBeNull();
  expect(screen.queryByRole('button')).toBeNull();
});

it('says the value before and offers to keep the new one, or to go back', async () => {
  open({ state: 'taken', saved: '0.3', message: '' });
  expect(screen.getByRole('status')).toHaveTextContent('Changed since the program was started. Before: 0.3');
  await user.click(screen.getByRole('button', { name: 'Keep this value' }));
  expect(onKeep).toHaveBeenCalledOnce();
  await user.click(screen.getByRole('button', { name: 'Back to the value before' }));
  expect(onBack).toHaveBeenCalledExactlyOnceWith('0.3');
});

it.each([
  [{ default: '0.2' }, 'Before: the default, 0.2'],
  [{}, 'Before: no value'],
])('says which value a port without one has: %o', (more, text) => {
  open({ state: 'next_start', saved: null, message: '' }, more);
  expect(screen.getByRole('status')).toHaveTextContent(text);
});

it('gives the reason why the program does not take a value', () => {
  open({ state: 'refused', saved: '1', message: 'No number.' });
  expect(screen.getByRole('status')).toHaveTextContent(
    /did not accept this value, and kept the one before \(1\)\. No number\.$/,
  );
});

it('tells while a value is typed how the running program gets it', async () => {
  await openSession();
  open(undefined, { isTyping: true });
  expect(screen.getByRole('status')).toHaveTextContent(
    'Press Enter to send this value to the running program.',
  );
});
