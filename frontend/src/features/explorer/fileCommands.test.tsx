import { waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { translates } from '@/i18n';
import { useFileDialog } from '@/store/dialogs/files';
import { useProjectStore } from '@/store/project';
import { useScope } from '@/store/revisions/scope';
import type { DocumentTab } from '@/workspace/documents';
import { loadLayout } from '@/workspace/layoutModel';
import { useTabs } from '@/workspace/tabs';
import { openProject } from '../../../harness/testing';
import { fileCommands } from './fileCommands';

const store = () => useProjectStore.getState();
const run = (id: string) => fileCommands.find((each) => each.id === id)!.run();
const enabled = (front: DocumentTab | null) => {
  useTabs.setState({ front });
  return fileCommands.filter((each) => each.enabled?.()).map(({ id }) => id.slice(5));
};

beforeEach(() => {
  openProject({
    trees: { Main: { r: { type: 'Sequence' } }, Dock: { d: { type: 'Sleep' } } },
    texts: { 'project.json': '{}', 'README.md': 'Hello', 'trees/Broken.json': '{' },
  });
  useTabs.setState({ model: loadLayout('wide', false), width: 'wide', front: null });
  useFileDialog.setState({ dialog: null });
});

describe('commands for the document in front', () => {
  it.each<[string, DocumentTab | null, string[]]>([
    ['nothing', null, []],
    ['a comparison', { kind: 'compare' }, []],
    ['the settings', { kind: 'file', path: 'project.json' }, []],
    ['the main tree', { kind: 'tree', id: 'Main' }, ['rename', 'history']],
    ['another tree', { kind: 'tree', id: 'Dock' }, ['rename', 'makeMain', 'history', 'delete']],
    ['a broken tree', { kind: 'file', path: 'trees/Broken.json' }, ['rename', 'history', 'delete']],
    ['a text', { kind: 'file', path: 'README.md' }, ['rename', 'history', 'delete']],
  ])('of %s', (_, front, expected) => {
    expect(enabled(front)).toEqual(expected);
  });

  it('rename it', () => {
    useTabs.setState({ front: { kind: 'tree', id: 'Dock' } });
    run('file.rename');
    expect(useFileDialog.getState().dialog).toEqual({ mode: 'rename', path: 'trees/Dock.json' });
  });

  it('make it the main tree', () => {
    useTabs.setState({ front: { kind: 'tree', id: 'Dock' } });
    run('file.makeMain');
    expect(store().mainTree).toBe('Dock');
  });

  it('show its history', () => {
    useScope.setState({ scope: 'project' });
    useTabs.setState({ front: { kind: 'file', path: 'README.md' } });
    run('file.history');
    expect(useScope.getState().scope).toBe('file');
  });

  it('delete it', async () => {
    useTabs.setState({ front: { kind: 'file', path: 'README.md' } });
    run('file.delete');
    await waitFor(() => expect(store().files).not.toHaveProperty(['README.md']));
  });

  it('do nothing if none is in front', () => {
    run('file.rename');
    run('file.makeMain');
    expect(useFileDialog.getState().dialog).toBeNull();
    expect(store().mainTree).toBe('Main');
  });

  it('have labels', () => {
    for (const { labelKey } of fileCommands) expect(translates(labelKey)).toBe(true);
  });
});
