import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import '@/i18n/editorTexts';
import type { Fix } from '@/model/fixes';
import { useProjectStore } from '@/store/project';
import { fakeServer, openProject, show, user, watchNavigation } from '../../harness/testing';
import { QuickFixes } from './QuickFixes';

const ACTION = 'actions/Go.py';
const UNIVERSE = 'universes/own.yaml';
const use: Fix = {
  key: 'use-topic',
  does: { makes: 'topic', path: ACTION, line: 1, said: '/a', other: '/b' },
  values: { other: '/b' },
};
const remap: Fix = {
  key: 'remap-topic',
  does: { makes: 'remap', path: UNIVERSE, sensor: 'camera', topic: '/a' },
  values: { sensor: 'camera', topic: '/a' },
};
const text = () => useProjectStore.getState().currentText(ACTION);

function open(source: string, universe = '') {
  fakeServer({});
  openProject({ texts: { [ACTION]: source, [UNIVERSE]: universe } });
  show(<QuickFixes tree="" fixes={[use, remap]} />);
}

it('undoes a fix only while the file is as the fix left it', async () => {
  open("listen('/a')\n");
  await user.click(screen.getByRole('button', { name: 'Subscribe to /b' }));
  expect(text()).toBe("listen('/b')\n");
  useProjectStore.getState().setFileText(ACTION, "listen('/b') # mine\n");
  await user.click(await screen.findByRole('button', { name: 'Undo' }));
  expect(text()).toBe("listen('/b') # mine\n");
  expect(await screen.findByText(/has changed since, so nothing was undone/)).toBeInTheDocument();
});

it('says nothing where the user types the value', async () => {
  const { focusField } = watchNavigation();
  openProject({ trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Sleep' } } } });
  const type: Fix = { key: 'type-value', does: { makes: 'typing', node: 'a', port: 'msec' }, values: {} };
  show(<QuickFixes tree="Main" fixes={[type]} />);
  await user.click(screen.getByRole('button', { name: 'Type a value' }));
  expect(focusField).toHaveBeenCalledExactlyOnceWith('msec');
  expect(screen.queryByText(/Nothing was changed/)).toBeNull();
});

it('says that nothing was changed', async () => {
  open('pass\n');
  await user.click(screen.getByRole('button', { name: 'Subscribe to /b' }));
  expect(await screen.findByText(/Nothing was changed/)).toBeInTheDocument();
});

it('says that a document with anchors cannot be changed piece by piece', async () => {
  open('', 'a: &a {camera: /x}\nrobots:\n  - {id: r, topics: *a}\n');
  await user.click(screen.getByTestId('fix-remap-topic'));
  expect(await screen.findByText(/shares values by anchors/)).toBeInTheDocument();
});
