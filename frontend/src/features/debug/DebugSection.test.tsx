import { act, screen } from '@testing-library/react';
import { afterEach, expect, it } from 'vitest';
import '@/i18n/editorTexts';
import { useBreakpoints } from '@/store/debug/breakpoints';
import { openDiagram } from '../../../harness/canvas';
import { show, user } from '../../../harness/testing';
import { DebugSection } from './DebugSection';

afterEach(() => act(() => useBreakpoints.setState({ list: [], areOn: true, refusal: '' })));

it('sets the breakpoint of the block, and shows its fields and a refusal', async () => {
  openDiagram({ root: 'a', nodes: { a: { type: 'Sleep' } } });
  show(<DebugSection tree="Main" node="a" />);
  await user.click(screen.getByRole('button', { name: 'Set a breakpoint' }));
  expect(screen.getByTestId('breakpoint-when')).toBeVisible();
  act(() => useBreakpoints.setState({ refusal: 'no' }));
  expect(screen.getByRole('alert')).toHaveTextContent('no');
  await user.click(screen.getByRole('button', { name: 'Remove the breakpoint' }));
  expect(screen.queryByTestId('breakpoint-when')).toBeNull();
});
