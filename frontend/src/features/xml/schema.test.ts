import { CompletionContext, type CompletionResult, type CompletionSource } from '@codemirror/autocomplete';
import { ensureSyntaxTree } from '@codemirror/language';
import { EditorState } from '@codemirror/state';
import { describe, expect, it } from 'vitest';
import { makeVocabulary, type NodeSpec } from '@/model/vocabulary';
import type { TreeFacts } from '@/model/treeFacts';
import { treeXml } from './schema';

const spec = (type: string, more: Partial<NodeSpec> = {}): NodeSpec => ({
  type,
  family: 'action',
  symbol: '',
  minChildren: 0,
  maxChildren: 0,
  ports: [],
  summary: '',
  open: false,
  source: 'builtin',
  ...more,
});

const port = (name: string, type: string, value: string | null) => ({
  name,
  direction: 'input' as const,
  type,
  default: value,
  required: false,
  description: '',
});

const vocabulary = makeVocabulary(
  [
    spec('Sequence', {
      family: 'control',
      maxChildren: Infinity,
      summary: 'One after the other.\nStops at failure.',
    }),
    spec('Go', {
      ports: [port('fast', 'bool', 'true'), port('speed', 'float', '0.3'), port('goal', 'string', null)],
    }),
    spec('SubTree', { family: 'subtree' }),
  ],
  [],
  new Map(['Main', 'Dock'].map((id) => [id, { calls: [] } as unknown as TreeFacts])),
);

/** Returns the completions at the bar in a text. */
async function offered(text: string) {
  const pos = text.indexOf('|');
  const begun = EditorState.create({ doc: text.replace('|', ''), extensions: treeXml(vocabulary) });
  // A busy machine may not have parsed all in the time that a state gives itself.
  ensureSyntaxTree(begun, pos, 60_000);
  const { state } = begun.update({});
  const [source] = state.languageDataAt<CompletionSource>('autocomplete', pos);
  const found = (await source?.(new CompletionContext(state, pos, true))) as CompletionResult | null;
  return found?.options ?? [];
}

const labels = async (text: string) =>
  (await offered(text)).map(({ label }) => label.replace(/^<|\/?>$|\s.*$/g, ''));

describe('treeXml', () => {
  it('offers the frame of a document', async () => {
    expect(await labels('<|')).toEqual(['root']);
    expect(await labels('<root><|')).toContain('BehaviorTree');
    expect(await labels('<root><|')).not.toContain('Sequence');
  });

  it('offers the nodes of the project, each with its summary', async () => {
    const options = await offered('<root><BehaviorTree><|');
    expect(options.map(({ label }) => label)).toEqual(expect.arrayContaining(['Sequence', 'Go', 'SubTree']));
    expect(options.find(({ label }) => label === 'Sequence')?.detail).toBe('One after the other.');
  });

  it('offers no child of a leaf', async () => {
    expect(await labels('<root><BehaviorTree><Go><|')).not.toContain('Sequence');
    expect(await labels('<root><BehaviorTree><Sequence><|')).toContain('Go');
  });

  it('offers ports, the name and conditions', async () => {
    const ports = ['fast', 'speed', 'goal', 'name', '_description', '_skipIf', '_onHalted'];
    expect(await labels('<root><BehaviorTree><Go |')).toEqual(expect.arrayContaining(ports));
    expect(await labels('<root><BehaviorTree><Sequence |')).not.toContain('speed');
    expect(await labels('<root><BehaviorTree><Sequence |')).toContain('_while');
  });

  it('offers values: of a boolean, the default, and of trees', async () => {
    const values = async (attribute: string) =>
      (await offered(`<root><BehaviorTree><${attribute}="|`)).map(({ label }) => label.replaceAll('"', ''));
    expect(await values('Go fast')).toEqual(['true', 'false']);
    expect(await values('Go speed')).toEqual(['0.3']);
    expect(await values('Go goal')).toEqual([]);
    expect(await values('SubTree ID')).toEqual(['Main', 'Dock']);
  });
});
