import { act, screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { HALL, openUniverse, UNIVERSE } from '../../../harness/documents';
import { fakeServer, show } from '../../../harness/testing';
import { UniverseTab } from './UniverseTab';

function tab(text = HALL, path = UNIVERSE) {
  fakeServer({ 'GET /catalog/robots': [], 'GET /catalog/universes': [] });
  const editor = openUniverse(text);
  act(() => editor.store.setState({ isTextShown: false }));
  show(<UniverseTab path={path} />);
  return editor;
}

const setText = (text: string) => {
  act(() => {
    useProjectStore.getState().setFileText(UNIVERSE, text);
  });
};

describe('the tab of a universe', () => {
  it('shows view, panel and tools, and no problem for a valid document', () => {
    tab();
    expect(screen.getByTestId('universe-editor')).toHaveAttribute('data-path', UNIVERSE);
    expect(screen.getByTestId('universe-view')).toBeInTheDocument();
    expect(screen.getByRole('listbox', { name: '5 things' })).toBeInTheDocument();
    expect(screen.getByRole('toolbar', { name: 'Tools of the world' })).toBeInTheDocument();
    expect(screen.queryByText(/the simulator would refuse/)).toBeNull();
  });

  it('records edits of the text as an undo step', () => {
    const editor = tab();
    setText(HALL.replace('name: Hall', 'name: Lab'));
    expect(editor.store.getState().undoStack.past.map(({ label }) => label)).toEqual(['text']);
    expect(screen.getByRole('textbox', { name: 'Name of the world' })).toHaveValue('Lab');
  });

  it('counts the problems, and still shows what can be shown', () => {
    tab(HALL.replace('mass: 0.4', 'mass: -1'));
    expect(screen.getByText('1 problem: the simulator would refuse this world')).toBeInTheDocument();
    expect(screen.getByTestId('universe-view')).toBeInTheDocument();
  });

  it('reports that a broken text cannot be shown, until it can', () => {
    tab('models: [');
    expect(screen.getByRole('alert')).toHaveTextContent('The text cannot be read as a world');
    expect(screen.queryByTestId('universe-view')).toBeNull();
    setText(HALL);
    expect(screen.getByTestId('universe-view')).toBeInTheDocument();
  });

  it('shows only the text if there is no such file', () => {
    tab(HALL, 'universes/gone.yaml');
    expect(screen.getByTestId('universe-editor-text')).toBeInTheDocument();
    expect(screen.queryByTestId('universe-editor')).toBeNull();
  });
});
