import { act, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { parse } from 'yaml';
import { useProjectStore } from '@/store/project';
import { useLargeFiles } from '@/store/saving/large';
import type { Story } from '@/store/recording/story';
import { action, fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { MomentForm } from './MomentForm';

const FILE = 'tests/moments.test.yaml';
const node = (uid: number, type: string, kind: string, id: string) => ({
  ...{ uid, parent: uid - 1, type, kind, name: type, path: `${type}::${uid}`, node_id: id, tree_id: 'Main' },
});
const story: Story = {
  nodes: [node(1, 'Sequence', 'Control', 'r'), node(2, 'Turn', 'Action', 'a')],
  statuses: [],
  entries: [{ scope: '', key: 'speed', type: 'double', value: 0.3, isPreview: false }],
  isWhole: true,
  ticks: [1, 2, 3].map((number) => ({
    ...{ number, t: number / 20, flashed: [], writes: [] },
    changed:
      number === 1
        ? [
            [1, 'RUNNING'],
            [2, 'RUNNING'],
          ]
        : [],
  })),
};

let outcome = 'passed';
let name = 'as at tick 3';

beforeEach(() => {
  outcome = 'passed';
  name = 'as at tick 3';
});

function open(texts: Record<string, string> = {}, path = FILE) {
  openProject({
    trees: { Main: { r: { type: 'Sequence', children: ['a'] }, a: { type: 'Turn' } } },
    actions: [action('Turn')],
    texts,
  });
  const failures = outcome === 'failed' ? [{ node: 'Turn', message: 'wanted A, got B' }] : [];
  fakeServer({
    [`POST /projects/${useProjectStore.getState().projectId}/test`]: {
      tests: [{ file: path, name, line: 1, tree: '', ticks: 3, outcome, failures, reached: {} }],
      problems: [],
      coverage: { share: 1, trees: {} },
    },
  });
  const navigation = watchNavigation();
  show(<MomentForm story={story} />);
  return navigation;
}

const textOf = (path = FILE) => useProjectStore.getState().currentText(path);
const write = () => user.click(screen.getByRole('button', { name: 'Write the test' }));

describe('a test of a moment', () => {
  it('is written with what was chosen, after it has passed', async () => {
    const { openFile } = open();
    await user.click(screen.getByRole('checkbox', { name: 'speed is 0.3' }));
    await write();
    await waitFor(() => expect(openFile).toHaveBeenCalledExactlyOnceWith(FILE, 4));
    expect((parse(textOf() ?? '') as { tests: object[] }).tests).toEqual([
      {
        name: 'as at tick 3',
        tree: 'Main',
        blackboard: { speed: 0.3 },
        doubles: { Turn: 'RUNNING' },
        tick_hz: 20,
        ticks: 3,
        expect: [
          { at: 'end', root: 'RUNNING' },
          { at: 'end', node: 'Turn', status: 'RUNNING' },
          { at: 'end', blackboard: { speed: 0.3 } },
        ],
      },
    ]);
    useProjectStore.getState().undo('Main');
    expect(textOf()).toBeNull();
  });

  it('goes back as far as is wanted', async () => {
    const { openFile } = open();
    const last = screen.getByRole('textbox', { name: 'Ticks' });
    await user.clear(last);
    await user.type(last, '2');
    expect(screen.getByRole('list', { name: 'What the test cannot repeat' })).toHaveTextContent(
      'Some blocks were running at the first of these ticks.',
    );
    await write();
    await waitFor(() => expect(openFile).toHaveBeenCalled());
    expect(textOf()).toContain('ticks: 2');
  });

  it('is added to a file, under another name than its tests', async () => {
    const path = 'tests/a.test.yaml';
    name = 'new';
    const { openFile } = open({ [path]: 'tests:\n  - name: as at tick 3\n' }, path);
    expect(screen.getByText('The file has a test of this name.')).toBeVisible();
    expect(screen.getByRole('button', { name: 'Write the test' })).toBeDisabled();
    const field = screen.getByRole('textbox', { name: 'Name' });
    await user.clear(field);
    expect(screen.getByText('A test needs a name.')).toBeVisible();
    await user.type(field, 'new');
    await write();
    await waitFor(() => expect(openFile).toHaveBeenCalledExactlyOnceWith(path, 4));
    expect(textOf(path)).toContain('- name: as at tick 3\n\n  - name: new');
  });

  it('is not written into a file with errors', () => {
    open({ 'tests/a.test.yaml': 'tests: [' });
    expect(screen.getByText(/No test can be added to this file/)).toBeVisible();
    expect(screen.getByRole('button', { name: 'Write the test' })).toBeDisabled();
  });

  it('waits for a large file, and says why it cannot be loaded', async () => {
    const path = 'tests/a.test.yaml';
    open();
    act(() => {
      const large = { path, kind: 'large', text: null, revision: 1, savedText: null } as const;
      useProjectStore.setState(({ files }) => ({ files: { ...files, [path]: large } }));
    });
    let answer: (file: Response) => void = () => undefined;
    vi.stubGlobal('fetch', () => new Promise<Response>((resolve) => (answer = resolve)));
    await user.click(screen.getByRole('combobox', { name: 'File' }));
    await user.click(await screen.findByRole('option', { name: path }));
    expect(screen.getByText(`${path} is loaded…`)).toBeVisible();
    expect(screen.queryByText(/No test can be added/)).toBeNull();
    act(() => answer(Response.json({ title: 'Not found', code: 'not_found' }, { status: 404 })));
    expect(await screen.findByText(/could not be loaded: Not found/)).toBeVisible();
    useLargeFiles.setState({ failed: {} });
  });

  it('that fails is written only if the user wants it', async () => {
    outcome = 'failed';
    const { openFile } = open();
    await write();
    expect(await screen.findByRole('alert')).toHaveTextContent('Turn: wanted A, got B');
    expect(textOf()).toBeNull();
    await user.click(screen.getByRole('button', { name: 'Write it anyway' }));
    expect(openFile).toHaveBeenCalledExactlyOnceWith(FILE, 4);
  });

  it('expects something', async () => {
    open();
    await user.click(screen.getByRole('checkbox', { name: 'The root returns RUNNING' }));
    await user.click(screen.getByRole('checkbox', { name: 'The status of 1 block that did something' }));
    expect(screen.getByText('Choose what the test expects.')).toBeVisible();
  });
});
