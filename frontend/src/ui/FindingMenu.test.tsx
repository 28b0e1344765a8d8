import { act, screen, waitFor } from '@testing-library/react';
import { expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { nodeOf, openProject, show, user } from '../../harness/testing';
import { FindingMenu } from './FindingMenu';

it('silences a finding with a reason, which undo takes back', async () => {
  openProject({ trees: { Main: { r: { type: 'ForceSuccess', children: [] } } } });
  show(<FindingMenu tree="Main" node="r" code="BT0119" message="It changes nothing." />);
  await user.click(screen.getByRole('button', { name: 'More about BT0119' }));
  await user.click(await screen.findByRole('menuitem', { name: 'Silence here…' }));
  const dialog = await screen.findByRole('dialog', { name: 'Silence BT0119 at this block' });
  expect(dialog).toHaveTextContent('It changes nothing.');
  const keep = screen.getByRole('button', { name: 'Silence' });
  expect(keep).toBeDisabled();
  await user.type(screen.getByRole('textbox', { name: /Reason/ }), '  ');
  expect(keep).toBeDisabled();
  await user.type(screen.getByRole('textbox', { name: /Reason/ }), 'it will fail later');
  await user.click(keep);
  expect(nodeOf('Main', 'r')?.silenced).toEqual({ BT0119: 'it will fail later' });
  await waitFor(() => expect(screen.queryByRole('dialog')).toBeNull());
  act(() => useProjectStore.getState().undo());
  expect(nodeOf('Main', 'r')?.silenced).toBeUndefined();
});
