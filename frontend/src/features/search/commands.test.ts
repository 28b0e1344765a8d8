import { describe, expect, it, onTestFinished } from 'vitest';
import { perform, useCommandTable } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { registerSearchCommands } from './commands';
import { useSearchStore } from './searchStore';

function register(role: 'owner' | 'viewer') {
  const end = registerSearchCommands();
  useProjectStore.setState({ role });
  onTestFinished(() => {
    end();
    useProjectStore.getState().close();
    useSearchStore.setState(useSearchStore.getInitialState(), true);
  });
}

describe('commands of the search', () => {
  it('open it, with and without the replacement', () => {
    register('owner');
    perform('view.search');
    expect(useSearchStore.getState()).toMatchObject({ asked: 1, isReplacing: false });
    perform('view.replace');
    expect(useSearchStore.getState()).toMatchObject({ asked: 2, isReplacing: true });
    expect(useCommandTable.getState().commands['view.search']?.shortcut).toBe('$mod+Shift+KeyF');
  });

  it('replace nothing for a viewer', () => {
    register('viewer');
    perform('view.replace');
    expect(useSearchStore.getState().asked).toBe(0);
  });
});
