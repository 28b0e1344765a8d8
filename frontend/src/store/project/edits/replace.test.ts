import { beforeEach, describe, expect, it } from 'vitest';
import { setName } from '@/model/edits';
import { seek, type Hits } from '@/model/search/seek';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '@/store/testing';
import { allPassages, replaceHits, type Replacement } from './replace';

const store = () => useProjectStore.getState();

const treeText = (id: string, port: string) =>
  JSON.stringify({
    format: 'bt-studio/diagram',
    version: 1,
    id,
    root: 'r',
    nodes: { r: { type: 'Go', name: 'speed', ports: { speed: port } } },
    drafts: [],
  });

beforeEach(() => {
  store().close();
  store().load(
    projectDetail(1, [
      projectFile('trees/MainTree.json', 1, treeText('MainTree', '{speed}')),
      projectFile('trees/Other.json', 1, treeText('Other', '{speed}')),
      projectFile('trees/Broken.json', 1, '{ speed'),
      projectFile('actions/Go.py', 1, 'speed = 1\n'),
    ]),
  );
});

/** Returns the replacements of a text everywhere in the current project. */
function plan(text: string, replacement: string): Replacement[] {
  const passages = allPassages(store());
  const query = { text, matchesCase: true, isWholeWord: false, isRegex: false };
  const { hits } = seek({ query, replacement, texts: passages.map((each) => each.text) }) as Hits;
  return passages
    .map((passage, index) => ({ passage, hits: hits.filter((hit) => hit.text === index) }))
    .filter((each) => each.hits.length > 0);
}

const portOf = (tree: string) => store().diagrams[tree]?.nodes['r']?.ports?.['speed'];
const codeText = () => store().currentText('actions/Go.py');

describe('allPassages', () => {
  it('has the texts of trees and files; an unreadable tree is a text', () => {
    const paths = new Set(allPassages(store()).map(({ path }) => path));
    expect([...paths]).toEqual([
      'trees/MainTree.json',
      'trees/Other.json',
      'actions/Go.py',
      'trees/Broken.json',
    ]);
  });
});

describe('replaceHits', () => {
  it('changes trees and files, but no names of ports', () => {
    const { count, documents } = replaceHits(plan('speed', 'v'));
    expect([count, documents]).toEqual([6, 4]);
    expect([portOf('MainTree'), portOf('Other'), codeText()]).toEqual(['{v}', '{v}', 'v = 1\n']);
    expect(store().currentText('trees/Broken.json')).toBe('{ v');
    expect(store().diagrams['MainTree']?.nodes['r']?.name).toBe('v');
  });

  it('is one step of each tree', () => {
    replaceHits(plan('speed', 'v'));
    store().undo();
    expect([portOf('MainTree'), portOf('Other')]).toEqual(['{speed}', '{v}']);
    store().undo('Other');
    expect(portOf('Other')).toBe('{speed}');
  });

  it('is reverted in one step, with the selection of the tree in front', () => {
    store().select('MainTree', ['r']);
    replaceHits(plan('speed', 'v')).undo();
    expect([portOf('MainTree'), portOf('Other'), codeText()]).toEqual(['{speed}', '{speed}', 'speed = 1\n']);
    expect(store().selection).toEqual(['r']);
    expect(store().pendingChanges()).toEqual([]);
  });

  it('does not revert later edits', () => {
    const { undo } = replaceHits(plan('speed', 'v'));
    store().apply('Other', 'rename', [setName('r', 'mine')]);
    store().setFileText('actions/Go.py', 'mine');
    undo();
    expect([portOf('MainTree'), portOf('Other'), codeText()]).toEqual(['{speed}', '{v}', 'mine']);
  });

  it('leaves texts that have changed since the search', () => {
    const planned = plan('speed', 'v');
    store().setFileText('actions/Go.py', 'speed = 2\n');
    expect(replaceHits(planned).documents).toBe(3);
    expect(codeText()).toBe('speed = 2\n');
  });

  it('does nothing in a read-only project', () => {
    useProjectStore.setState({ role: 'viewer' });
    expect(replaceHits(plan('speed', 'v')).count).toBe(0);
    expect([portOf('MainTree'), codeText()]).toEqual(['{speed}', 'speed = 1\n']);
  });
});
