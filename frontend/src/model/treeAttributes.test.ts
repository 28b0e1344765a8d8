import { describe, expect, it } from 'vitest';
import { emptyDiagram, type Diagram } from './diagram';
import { edit, setDescription, setOffered } from './edits';
import { parseDiagram, serializeDiagram } from './serialize';
import { descriptionOf, isOffered } from './treeAttributes';

const dock: Diagram = { ...emptyDiagram('Dock'), attributes: { _fullpath: 'a/Dock' } };

describe('what a tree says of itself', () => {
  it('is kept in its file, beside attributes of other programs', () => {
    const { diagram } = edit(dock, setDescription('Goes home.'), setOffered(true));
    const read = parseDiagram(serializeDiagram(diagram));
    expect([descriptionOf(read), isOffered(read)]).toEqual(['Goes home.', true]);
    expect(read.attributes).toMatchObject({ _fullpath: 'a/Dock' });
  });

  it('leaves no trace when it is taken back', () => {
    const plain = emptyDiagram('Dock');
    const said = edit(plain, setDescription('Goes home.'), setOffered(true)).diagram;
    expect(edit(said, setDescription('  '), setOffered(false)).diagram).toEqual(plain);
  });

  it.each([null, [], 'text', { _description: 5, _bts_offered: true }])('is nothing in %j', (attributes) => {
    const broken = { ...dock, attributes } as unknown as Diagram;
    expect([descriptionOf(broken), isOffered(broken)]).toEqual(['', false]);
    expect(descriptionOf(edit(broken, setDescription('Waits.')).diagram)).toBe('Waits.');
  });
});
