import { act, screen } from '@testing-library/react';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useRunStore } from '@/store/run/store';
import { openUniverse } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import type { Mode } from './editing';
import { EditorToolbar, Tool } from './EditorToolbar';

const canRun = () =>
  onTestFinished(registerCommands([{ id: 'run.run', group: 'run', labelKey: '', run: () => undefined }]));

function toolbar(modes: readonly Mode[] = ['move', 'turn']) {
  const editor = openUniverse('a: 1\n');
  editor.store.setState({ isTextShown: false });
  const onRun = vi.fn();
  show(
    <EditorToolbar
      editor={editor}
      label="Tools"
      modes={modes}
      grids={[0, 0.005, 0.05, 1]}
      textLabel="The text"
      textTestId="text"
      onRun={onRun}
    >
      <p>own tool</p>
    </EditorToolbar>,
  );
  return { editor, state: () => editor.store.getState(), onRun };
}

const button = (name: string) => screen.getByRole('button', { name });

describe('the toolbar of an editor', () => {
  it('sets the mode of dragging, and ends the wall tool', async () => {
    const { editor, state } = toolbar();
    expect(screen.getAllByRole('radio')).toHaveLength(2);
    expect(screen.getByText('own tool')).toBeInTheDocument();
    act(() => editor.store.setState({ tool: 'wall' }));
    for (const radio of screen.getAllByRole('radio')) expect(radio).not.toBeChecked();
    await user.click(screen.getByRole('radio', { name: 'Turn' }));
    expect(state()).toMatchObject({ mode: 'turn', tool: 'select' });
    expect(screen.getByRole('radio', { name: 'Turn' })).toBeChecked();
  });

  it('names fine grids in millimetres', async () => {
    const { state } = toolbar();
    await user.click(screen.getByRole('combobox', { name: 'Grid' }));
    const options = await screen.findAllByRole('option');
    expect(options.map(({ textContent }) => textContent)).toEqual(['No grid', '5 mm', '0.05 m', '1 m']);
    await user.click(options[1]!);
    expect(state().grid).toBe(0.005);
  });

  it.each([
    ['From above (T)', 'top'],
    ['From the side (P)', 'default'],
    ['Go to the selection (F)', 'selection'],
  ])('%s moves the camera', async (name, kind) => {
    const { state } = toolbar();
    const before = state().viewpoint;
    await user.click(button(name));
    expect(state().viewpoint).toEqual({ kind });
    expect(state().viewpoint).not.toBe(before);
  });

  it('leaves undo to the buttons of the page', () => {
    toolbar();
    expect(screen.queryByRole('button', { name: /undo|redo/i })).toBeNull();
  });

  it('shows and hides the text', async () => {
    const { state } = toolbar();
    expect(button('The text')).toHaveAttribute('aria-pressed', 'false');
    await user.click(screen.getByTestId('text'));
    expect(state().isTextShown).toBe(true);
    expect(button('The text')).toHaveAttribute('aria-pressed', 'true');
  });

  it('runs this document if the project can run', async () => {
    canRun();
    const { onRun } = toolbar();
    await user.click(screen.getByTestId('run-here'));
    expect(onRun).toHaveBeenCalledOnce();
    act(() => useRunStore.setState({ runBlocker: 'viewer' as never }));
    expect(screen.getByTestId('run-here')).toBeDisabled();
    act(() => useRunStore.setState({ runBlocker: null }));
  });

  it('has no run button without a command', () => {
    toolbar();
    expect(screen.getByTestId('run-here')).toBeDisabled();
  });
});

describe('Tool', () => {
  it('is a button with a name', async () => {
    const onClick = vi.fn();
    show(
      <Tool label="Walls" testId="walls" onClick={onClick}>
        W
      </Tool>,
    );
    await user.click(button('Walls'));
    expect(onClick).toHaveBeenCalledOnce();
    expect(screen.getByTestId('walls')).toBeEnabled();
  });
});
