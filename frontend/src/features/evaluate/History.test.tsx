import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { evaluation } from '../../../harness/evaluations';
import { show, user } from '../../../harness/testing';
import { History } from './History';

it('lists evaluations with revision, rate and state', async () => {
  const onShow = vi.fn();
  const items = [evaluation(), evaluation({ id: 'e2', name: 'hall', older: 3, state: 'done' })];
  show(<History items={items} shown="e2" onShow={onShow} />);
  const [first, second] = screen.getAllByRole('button');
  expect(first).toHaveTextContent('room Revision 750 % · Running');
  expect(second).toHaveTextContent('hall Revision 7 against 3');
  expect(second).toHaveAttribute('aria-current', 'true');
  await user.click(first!);
  expect(onShow).toHaveBeenCalledWith('e1');
});
