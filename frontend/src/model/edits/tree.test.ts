import { expect, it } from 'vitest';
import { emptyDiagram } from '../diagram';
import { edit } from './core';
import { setDescription, setOffered } from './tree';

const plain = emptyDiagram('Dock');

it('keeps attributes of other programs', () => {
  const imported = { ...plain, attributes: { _fullpath: 'a/Dock' } };
  const { diagram } = edit(imported, setDescription('Goes home.'), setOffered(true));
  expect(diagram.attributes).toEqual({
    _fullpath: 'a/Dock',
    _description: 'Goes home.',
    _bts_offered: '1',
  });
  expect(edit(diagram, setDescription(''), setOffered(false)).diagram).toEqual(imported);
});

it('leaves no trace when nothing is said any more', () => {
  const said = edit(plain, setDescription('Goes home.')).diagram;
  expect(edit(said, setDescription('  ')).diagram).toEqual(plain);
});
