import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { ApiError } from '@/api/errors';
import { trees } from '@/api/trees';
import { parseDiagram, serializeDiagram } from '@/model/serialize';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '../testing';
import { cachedXml } from './cache';
import { XmlLink } from './link';

const TREE = 'MainTree';

const project = () => projectDetail(1, [projectFile(`trees/${TREE}.json`, 1, oneBlock(TREE, 'A'))]);

/** Returns a fake translator for trees of one block: `<type/>`, with a comment that the text keeps. */
function translate() {
  const typeIn = (xml: string) => /^(?:<!--.*-->)?<(\w+)\/>$/.exec(xml)?.[1];
  const rangesOf = (xml: string) => [{ node: 'n1', start: 0, open_end: xml.length, end: xml.length }];
  vi.spyOn(trees, 'write').mockImplementation((diagram, base = '') => {
    const type = parseDiagram(diagram).nodes['n1']?.type ?? '';
    const xml = base === '' ? `<${type}/>` : base.replace(/<\w+\/>/, `<${type}/>`);
    return Promise.resolve({ xml, ranges: rangesOf(xml) });
  });
  vi.spyOn(trees, 'read').mockImplementation((xml, diagram) => {
    const type = typeIn(xml);
    if (type === undefined) {
      const diagnostics = [{ code: 'BT0701', severity: 'error' as const, message: 'no', line: 1 }];
      return Promise.resolve({ xml, ranges: [], diagram: null, diagnostics });
    }
    const now = parseDiagram(diagram);
    const next = serializeDiagram({ ...now, nodes: { n1: { ...now.nodes['n1'], type } } });
    return Promise.resolve({ xml, ranges: rangesOf(xml), diagram: next, diagnostics: [] });
  });
}

const store = () => useProjectStore.getState();
const type = () => store().diagrams[TREE]?.nodes['n1']?.type;
const onCanvas = (to: string) =>
  store().apply(TREE, 'morph', [
    (draft) => {
      draft.nodes['n1'] = { type: to };
    },
  ]);

let stop: (() => void) | null = null;
async function open(): Promise<XmlLink> {
  const link = new XmlLink('p1', TREE);
  stop = link.start();
  await settle();
  return link;
}
const settle = () => vi.advanceTimersByTimeAsync(1000);

beforeEach(() => {
  vi.useFakeTimers();
  localStorage.clear();
  store().load(project());
  translate();
});
afterEach(() => {
  stop?.();
  vi.useRealTimers();
});

describe('the text of a tree', () => {
  it('follows the canvas, and keeps comments', async () => {
    const link = await open();
    expect(link.get()).toMatchObject({ text: '<A/>', state: { kind: 'inStep' } });
    link.edited('<!--why--><A/>');
    await settle();
    onCanvas('B');
    await settle();
    expect(link.get().text).toBe('<!--why--><B/>');

    stop?.();
    onCanvas('C');
    expect((await open()).get()).toMatchObject({ text: '<!--why--><C/>', isRestored: false });
  });

  it('changes the tree in one step of undo, and follows the undo', async () => {
    const link = await open();
    for (const text of ['<A', '<Ab', '<Abc/>']) link.edited(text);
    await settle();
    expect(type()).toBe('Abc');
    expect(store().histories[TREE]?.past).toHaveLength(1);
    store().undo();
    await settle();
    expect(type()).toBe('A');
    expect(link.get()).toMatchObject({ text: '<A/>', state: { kind: 'inStep' } });
  });

  it('leaves the tree unchanged while it is invalid, and is restored after a reload', async () => {
    const link = await open();
    link.edited('<B');
    await settle();
    expect(link.get().state).toMatchObject({ kind: 'broken', findings: [{ code: 'BT0701' }] });
    expect(type()).toBe('A');
    stop?.();
    const again = await open();
    expect(again.get()).toMatchObject({ text: '<B', isRestored: true, state: { kind: 'broken' } });
    again.edited('<B/>');
    await settle();
    expect(type()).toBe('B');
    expect(again.get().isRestored).toBe(false);
  });

  it('asks when the canvas was changed meanwhile, and keeps both until then', async () => {
    const link = await open();
    link.edited('<B');
    await settle();
    onCanvas('C');
    expect(link.get()).toMatchObject({ text: '<B', state: { kind: 'parted' } });
    link.edited('<B/>');
    await settle();
    expect([type(), link.get().state.kind]).toEqual(['C', 'parted']);
    link.keepText();
    await settle();
    expect([type(), link.get().state.kind]).toEqual(['B', 'inStep']);
    store().undo();
    expect(type()).toBe('C');
  });

  it('can be generated again from the tree', async () => {
    const link = await open();
    link.edited('<B');
    onCanvas('C');
    link.keepTree();
    await settle();
    expect(link.get()).toMatchObject({ text: '<C/>', state: { kind: 'inStep' } });
    expect(cachedXml('p1', TREE)?.text).toBe('<C/>');
  });

  it('also asks when the canvas was changed while the panel was closed', async () => {
    const link = await open();
    link.edited('<B');
    stop?.();
    onCanvas('C');
    expect((await open()).get()).toMatchObject({ text: '<B', isRestored: true, state: { kind: 'parted' } });
  });

  it('is stored, and read later, when the server cannot be reached', async () => {
    const link = await open();
    const offline = new ApiError({ title: 'gone', status: 0, code: 'offline' });
    vi.spyOn(trees, 'read').mockRejectedValueOnce(offline);
    link.edited('<B/>');
    await settle();
    expect(link.get().state).toMatchObject({ kind: 'failed' });
    expect(cachedXml('p1', TREE)?.text).toBe('<B/>');
    await vi.advanceTimersByTimeAsync(5000);
    expect([type(), link.get().state.kind]).toEqual(['B', 'inStep']);
  });
});
