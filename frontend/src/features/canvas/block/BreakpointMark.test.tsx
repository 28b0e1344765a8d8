import { act, screen } from '@testing-library/react';
import i18next from 'i18next';
import { afterEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import {
  changeBreakpoint,
  switchBreakpoints,
  toggleBreakpoint,
  useBreakpoints,
} from '@/store/debug/breakpoints';
import { show, user } from '../../../../harness/testing';
import { BreakpointMark } from './BreakpointMark';

afterEach(() => act(() => useBreakpoints.setState({ list: [], areOn: true })));
const mark = (isSelected: boolean) => (
  <BreakpointMark tree="Main" node="a" isSelected={isSelected} t={i18next.getFixedT('en', 'canvas')} />
);

it('marks a block with a breakpoint, and tells whether it has an effect', () => {
  show(mark(false));
  expect(screen.queryByRole('button')).toBeNull();
  act(() => toggleBreakpoint('Main', 'a'));
  expect(screen.getByRole('button')).toHaveAccessibleName('Breakpoint: the run is held before this block');
  act(() => changeBreakpoint('Main', 'a', { when: 'after', condition: 'x > 1' }));
  expect(screen.getByRole('button')).toHaveAttribute('data-state', 'other');
  expect(screen.getByRole('button')).toHaveAttribute('data-condition', '');
  act(switchBreakpoints);
  expect(screen.getByRole('button')).toHaveAccessibleName('Breakpoint without effect: it is switched off');
});

it('sets and removes the breakpoint of a selected block', async () => {
  show(mark(true));
  const dot = screen.getByRole('button', { name: 'Set a breakpoint', pressed: false });
  await user.click(dot);
  expect(useBreakpoints.getState().list).toHaveLength(1);
  await user.click(screen.getByRole('button', { pressed: true }));
  expect(useBreakpoints.getState().list).toEqual([]);
});
