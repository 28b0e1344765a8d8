import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import type { Candidate } from '@/api/imports';
import '@/i18n/editorTexts';
import { show, user } from '../../../harness/testing';
import { Choice, likelyOf } from './Choice';

const item = (path: string, more: Partial<Candidate> = {}): Candidate => ({
  ...{ kind: 'robot', source: 'xacro', path, name: 'a', is_main: true, arguments: [] },
  ...more,
});
const CART = item('cart.xacro');
const WHEEL = item('wheel.xacro', { is_main: false });
const YARD = item('yard.sdf', { kind: 'universe', source: 'sdf' });

it('shows first what is likely, then all', async () => {
  expect(likelyOf([WHEEL, CART, YARD], 'robot')).toEqual([CART]);
  expect(likelyOf([WHEEL], 'universe')).toEqual([WHEEL]);
  const onChoose = vi.fn();
  show(<Choice items={[CART, WHEEL, YARD]} kind={null} chosen={CART} onChoose={onChoose} />);
  expect(screen.getAllByRole('radio')).toHaveLength(2);
  await user.click(screen.getByRole('button', { name: 'Show 1 more file' }));
  expect(screen.getByRole('radio', { name: /cart/ })).toHaveFocus();
  await user.click(screen.getByRole('radio', { name: /wheel/ }));
  expect(onChoose).toHaveBeenCalledExactlyOnceWith(WHEEL);
});

it('shows all where an unlikely one is chosen', () => {
  show(<Choice items={[CART, WHEEL]} kind={null} chosen={WHEEL} onChoose={vi.fn()} />);
  expect(screen.getByRole('radio', { name: /wheel/ })).toBeChecked();
});
