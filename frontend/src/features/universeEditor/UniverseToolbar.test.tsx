import { act, screen } from '@testing-library/react';
import { describe, expect, it, onTestFinished, vi } from 'vitest';
import { registerCommands } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { openUniverse } from '../../../harness/documents';
import { show, user } from '../../../harness/testing';
import { UniverseToolbar } from './UniverseToolbar';

function toolbar() {
  const run = vi.fn();
  onTestFinished(registerCommands([{ id: 'run.run', group: 'run', labelKey: '', run }]));
  onTestFinished(() => useUniverseChoice.setState(useUniverseChoice.getInitialState(), true));
  const editor = openUniverse();
  show(<UniverseToolbar editor={editor} />);
  return { editor, run };
}

describe('the toolbar of a universe', () => {
  it('starts and ends the wall tool', async () => {
    const { editor } = toolbar();
    const walls = screen.getByRole('button', { name: 'Draw walls (W)' });
    expect(walls).toHaveAttribute('aria-pressed', 'false');
    await user.click(walls);
    expect(editor.store.getState().tool).toBe('wall');
    expect(walls).toHaveAttribute('aria-pressed', 'true');
    await user.click(walls);
    expect(editor.store.getState().tool).toBe('select');
  });

  it("runs in this universe once, whatever the project's universe is", async () => {
    const { run } = toolbar();
    await user.click(screen.getByTestId('run-here'));
    expect(useUniverseChoice.getState().universe).toBe('hall');
    expect(run).toHaveBeenCalledOnce();
  });

  it("chooses nothing if it is the project's own", async () => {
    const { run } = toolbar();
    act(() => {
      useUniverseChoice.setState({ universe: 'other' });
      useProjectStore.getState().setSettings({ universe: 'hall' });
    });
    await user.click(screen.getByTestId('run-here'));
    expect(useUniverseChoice.getState().universe).toBeNull();
    expect(run).toHaveBeenCalledOnce();
  });

  it('offers all three gestures, and its grids', async () => {
    const { editor } = toolbar();
    expect(screen.getByRole('toolbar', { name: 'Tools of the world' })).toBeInTheDocument();
    expect(screen.getAllByRole('radio').map((radio) => (radio as HTMLInputElement).value)).toEqual([
      'move',
      'turn',
      'size',
    ]);
    await user.click(screen.getByRole('combobox', { name: 'Grid' }));
    expect((await screen.findAllByRole('option')).map(({ textContent }) => textContent)).toEqual([
      'No grid',
      '0.05 m',
      '0.1 m',
      '0.5 m',
    ]);
    await user.click(screen.getByRole('option', { name: '0.5 m' }));
    expect(editor.store.getState().grid).toBe(0.5);
  });
});
