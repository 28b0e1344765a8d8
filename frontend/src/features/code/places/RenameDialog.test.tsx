import { EditorView } from '@codemirror/view';
import { act, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { show, user } from '../../../../harness/testing';
import type { PlacesInFile } from '../language/places';
import { leaveRename, useRename } from '../language/rename';
import { RenameDialog } from './RenameDialog';

const URI = 'file:///project/actions/Go.py';
const GROUPS: readonly PlacesInFile[] = [
  {
    uri: URI,
    name: 'actions/Go.py',
    isOutside: false,
    places: [{ uri: URI, line: 0, from: 6, to: 8, text: 'class Go:' }],
  },
];
const request = () => useRename.getState().request;
const field = () => screen.getByRole('textbox', { name: 'New name of Go' });
const submit = () => screen.getByRole('button', { name: 'Rename' });

function open(groups: readonly PlacesInFile[] | null = GROUPS) {
  const view = new EditorView({ doc: 'class Go:' });
  onTestFinished(() => view.destroy());
  act(() => useRename.setState({ request: { view, uri: URI, at: 6, before: 'Go', groups } }));
}

beforeEach(() => {
  onTestFinished(leaveRename);
  show(<RenameDialog uri={URI} />);
});

describe('RenameDialog', () => {
  it('is that of its own file', () => {
    open();
    expect(screen.getByRole('dialog', { name: 'Rename Go' })).toBeInTheDocument();
    act(() =>
      useRename.setState(({ request: old }) => ({ request: old && { ...old, uri: 'file:///other' } })),
    );
    expect(screen.queryByRole('textbox')).toBeNull();
  });

  it('shows each line that changes, as the name is typed', async () => {
    open();
    expect(screen.getByRole('status')).toHaveTextContent('1 place in 1 file');
    const preview = screen.getByRole('region', { name: 'Lines that change' });
    expect(preview).toHaveTextContent('class Go:');
    await user.clear(field());
    await user.type(field(), 'Drive');
    expect(within(preview).getByText('Drive')).toBeInTheDocument();
    await user.clear(field());
    await user.type(field(), '3D');
    expect(screen.getByText('“3D” cannot be a name in Python.')).toBeInTheDocument();
    expect(submit()).toBeDisabled();
    expect(preview).toHaveTextContent('class Go:');
  });

  it('waits for the places', () => {
    open(null);
    expect(screen.getByRole('status')).toHaveTextContent('Searching for its uses…');
    expect(submit()).toBeDisabled();
  });

  it.each(['Cancel', 'Rename'])('leaves an equal name by %s', async (button) => {
    open();
    await user.click(screen.getByRole('button', { name: button }));
    expect(request()).toBeNull();
  });

  it('is cancelled by Esc', async () => {
    open();
    await user.keyboard('{Escape}');
    expect(request()).toBeNull();
  });
});
