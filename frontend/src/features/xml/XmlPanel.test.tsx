import { EditorView } from '@codemirror/view';
import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, nodeOf, openProject, show, user } from '../../../harness/testing';
import { XmlPanel } from './XmlPanel';

const WRITE = 'POST /trees/xml';
const READ = 'POST /trees/diagram';
const TEXT = '<root>\n  <Sequence/>\n</root>';
const RANGES = [{ node: 'n1', start: 9, open_end: 20, end: 20 }];

let answers: Record<string, unknown>;
let requests: ReturnType<typeof fakeServer>['requests'];

const editor = () => {
  const view = EditorView.findFromDOM(screen.getByTestId('xml-editor'));
  if (!view) throw new Error('There is no editor.');
  return view;
};
const text = () => editor().state.doc.toString();
const type = (words: string) => {
  act(() => editor().dispatch({ changes: { from: 0, to: text().length, insert: words } }));
};
const state = () => screen.getByTestId('xml-state').dataset['state'];
const said = () => within(screen.getByTestId('xml-state')).getByRole('status');

beforeEach(() => {
  answers = { [WRITE]: { xml: TEXT, ranges: RANGES } };
  ({ requests } = fakeServer(answers));
  openProject({ trees: { Main: { n1: { type: 'Sequence' } } } });
  useProjectStore.getState().setActiveTree('Main');
  onTestFinished(() => localStorage.clear());
});

async function open() {
  const view = show(<XmlPanel />);
  await screen.findByText('Text and tree agree');
  return view;
}

describe('XmlPanel', () => {
  it('asks for a tree to be opened', () => {
    useProjectStore.setState({ activeTree: null });
    show(<XmlPanel />);
    expect(screen.getByText('Open a tree to see its XML.')).toBeInTheDocument();
    expect(screen.queryByTestId('xml-state')).toBeNull();
  });

  it('asks for a tree also if the previous one was deleted', () => {
    useProjectStore.setState({ activeTree: 'Gone' });
    show(<XmlPanel />);
    expect(screen.getByText('Open a tree to see its XML.')).toBeInTheDocument();
  });

  it('writes the tree as XML', async () => {
    show(<XmlPanel />);
    expect(state()).toBe('loading');
    expect(said()).toHaveTextContent('Writing the tree as XML…');
    expect(screen.queryByTestId('xml-editor')).toBeNull();
    expect(await screen.findByText('Text and tree agree')).toBeInTheDocument();
    expect(text()).toBe(TEXT);
    expect(screen.getByRole('textbox', { name: 'XML of the tree Main' })).toBeInTheDocument();
    expect(screen.queryByRole('alert')).toBeNull();
    expect(screen.queryByRole('button', { name: 'Try again' })).toBeNull();
  });

  it('applies typed text to the tree', async () => {
    await open();
    const diagram = oneBlock('Main', 'Fallback');
    answers[READ] = { xml: '', ranges: RANGES, diagram, diagnostics: [] };
    type('<Fallback/>');
    expect(state()).toBe('reading');
    expect(said()).toHaveTextContent('Reading the text…');
    await waitFor(() => expect(state()).toBe('inStep'));
    expect(nodeOf('Main', 'n1')?.type).toBe('Fallback');
    expect(requests.at(-1)?.body).toMatchObject({ xml: '<Fallback/>' });
    expect(text()).toBe('<Fallback/>');
  });

  it('reports what is wrong with the text, and leaves the tree', async () => {
    await open();
    const finding = { code: 'X1', severity: 'error', message: 'No such node.', line: 2 };
    answers[READ] = { xml: '', ranges: [], diagram: null, diagnostics: [finding] };
    type('<root>\n<Nobody/>');
    await waitFor(() => expect(state()).toBe('broken'));
    expect(said()).toHaveTextContent('Line 2: No such node. The tree stays as it is.');
    expect(nodeOf('Main', 'n1')?.type).toBe('Sequence');
    expect(editor().dom.querySelector('.cm-lintRange-error')?.textContent).toBe('<Nobody/>');
  });

  it('shows the text of a tree that was edited elsewhere', async () => {
    await open();
    answers[WRITE] = { xml: '<root>\n  <Fallback/>\n</root>', ranges: RANGES };
    act(() =>
      useProjectStore.getState().apply('Main', 'rename', [(draft) => void (draft.nodes['n1']!.name = 'x')]),
    );
    await waitFor(() => expect(text()).toContain('<Fallback/>'));
    expect(state()).toBe('inStep');
    expect(requests.filter(({ path }) => path === '/trees/diagram')).toEqual([]);
  });

  it('reports that the server cannot be reached, and tries again', async () => {
    answers[WRITE] = refusal('It is busy.', { status: 503 });
    show(<XmlPanel />);
    await waitFor(() => expect(state()).toBe('failed'));
    expect(said()).toHaveTextContent(
      'The text is not applied yet, since the server did not answer: It is busy.',
    );
    answers[WRITE] = { xml: TEXT, ranges: RANGES };
    await user.click(screen.getByRole('button', { name: 'Try again' }));
    await waitFor(() => expect(state()).toBe('inStep'));
    expect(text()).toBe(TEXT);
  });

  describe('when text and tree were both changed', () => {
    beforeEach(async () => {
      await open();
      const finding = { code: 'X1', severity: 'error', message: 'bad', line: 1 };
      answers[READ] = { xml: '', ranges: [], diagram: null, diagnostics: [finding] };
      type('<Mine');
      await waitFor(() => expect(state()).toBe('broken'));
      act(() =>
        useProjectStore.getState().apply('Main', 'rename', [(draft) => void (draft.nodes['n1']!.name = 'x')]),
      );
    });

    it('asks which one to keep', () => {
      expect(state()).toBe('parted');
      expect(screen.getByRole('alert')).toHaveTextContent(/Which one do you keep\?/);
      expect(said()).toHaveTextContent('Text and tree differ');
    });

    it('keeps the text', async () => {
      answers[READ] = { xml: '', ranges: [], diagram: oneBlock('Main', 'Fallback'), diagnostics: [] };
      await user.click(screen.getByRole('button', { name: 'My text' }));
      await waitFor(() => expect(nodeOf('Main', 'n1')?.type).toBe('Fallback'));
      expect(text()).toBe('<Mine');
      expect(screen.queryByRole('alert')).toBeNull();
    });

    it('keeps the tree', async () => {
      answers[WRITE] = { xml: '<Sequence name="x"/>', ranges: [] };
      await user.click(screen.getByRole('button', { name: 'The tree' }));
      await waitFor(() => expect(text()).toBe('<Sequence name="x"/>'));
      expect(nodeOf('Main', 'n1')).toMatchObject({ type: 'Sequence', name: 'x' });
      expect(screen.queryByRole('alert')).toBeNull();
    });
  });

  it('restores text that was not applied', async () => {
    const { unmount } = await open();
    const finding = { code: 'X1', severity: 'error', message: 'bad', line: 1 };
    answers[READ] = { xml: '', ranges: [], diagram: null, diagnostics: [finding] };
    type('<Half');
    unmount();
    show(<XmlPanel />);
    await waitFor(() => expect(state()).toBe('broken'));
    expect(text()).toBe('<Half');
    expect(said()).toHaveTextContent('Your text was restored. Line 1: bad The tree stays as it is.');
  });

  it('shows ids and positions on demand, also the next time', async () => {
    answers[WRITE] = { xml: '<Sequence _bts_id="n1"/>', ranges: [] };
    const { unmount } = await open();
    const line = () => editor().dom.querySelector('.cm-line')?.textContent;
    const option = () => screen.getByRole('checkbox', { name: 'Ids and positions' });
    expect([line(), (option() as HTMLInputElement).checked]).toEqual(['<Sequence/>', false]);
    await user.click(option());
    expect(line()).toBe('<Sequence _bts_id="n1"/>');
    expect(localStorage.getItem('bts.xml.metadata')).toBe('yes');
    unmount();
    await open();
    expect(line()).toBe('<Sequence _bts_id="n1"/>');
    await user.click(option());
    expect(line()).toBe('<Sequence/>');
    expect(localStorage.getItem('bts.xml.metadata')).toBe('no');
  });
});
