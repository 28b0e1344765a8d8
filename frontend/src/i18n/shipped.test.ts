import i18next from 'i18next';
import { readdirSync, readFileSync } from 'node:fs';
import { afterEach, describe, expect, it } from 'vitest';
import { setLanguage } from '.';
import './editorTexts';
import { descriptionOf } from '@/model/treeAttributes';
import { parseDiagram } from '@/model/serialize';
import { shippedDoc, shippedPort } from './shipped';
import english from './locales/en/shipped.json';

afterEach(() => setLanguage('en'));

describe('what shipped nodes, actions and trees say', () => {
  it('is translated to the language of the page', () => {
    setLanguage('es');
    expect(shippedDoc('Turn', 'Turns on the spot.')).toBe('Gira sobre sí mismo.');
    expect(shippedPort('Forward', 'lin_speed', 'Speed ahead in m/s.')).toBe('Velocidad de avance en m/s.');
  });

  it('has every text of the built-in nodes in Spanish', () => {
    setLanguage('es');
    const { nodes } = JSON.parse(readFileSync('../tree_gardener/catalog.json', 'utf8')) as {
      nodes: { type: string; summary: string; ports: { name: string; description: string }[] }[];
    };
    const left = nodes.flatMap(({ type, summary, ports }) => [
      ...(shippedDoc(type, summary) === summary ? [type] : []),
      ...ports
        .filter(({ name, description }) => shippedPort(type, name, description) === description)
        .map(({ name }) => `${type}.${name}`),
    ]);
    expect(left, 'write them in locales/en/shipped.json and locales/es/shipped.json').toEqual([]);
  });

  it('has the description of every tree of the library', () => {
    setLanguage('es');
    const { behaviours } = JSON.parse(readFileSync('../backend/catalog/behaviours/library.json', 'utf8')) as {
      behaviours: { id: string; summary: { es: string } }[];
    };
    const shown = behaviours.map(({ id }) => {
      const text = readFileSync(`../backend/catalog/behaviours/trees/${id}.json`, 'utf8');
      return shippedDoc(id, descriptionOf(parseDiagram(text)));
    });
    expect(shown).toEqual(behaviours.map(({ summary }) => summary.es));
  });

  it('stays as the user wrote it', () => {
    setLanguage('es');
    expect(shippedDoc('Turn', 'Turns slowly.')).toBe('Turns slowly.');
    expect(shippedPort('Mine', 'speed', 'Speed ahead in m/s.')).toBe('Speed ahead in m/s.');
    expect(shippedPort('Turn', 'toString', 'x')).toBe('x');
    expect(shippedDoc('', '')).toBe('');
  });

  it('equals the examples in English', () => {
    const folder = '../examples';
    const sources = readdirSync(folder, { recursive: true, encoding: 'utf8' })
      .filter((path) => /actions\/\w+\.py$/.test(path))
      .map((path) => readFileSync(`${folder}/${path}`, 'utf8'))
      .join('\n');
    const nodes = readFileSync('../tree_gardener/catalog.json', 'utf8');
    const library = readFileSync('../backend/catalog/behaviours/library.json', 'utf8');
    const texts = Object.values(english).flatMap((all) =>
      all.flatMap(({ doc, ports }) => [doc, ...Object.values(ports)]),
    );
    expect(texts.filter((text) => !`${sources}${nodes}${library}`.includes(text))).toEqual([]);
    expect(i18next.hasResourceBundle('es', 'shipped')).toBe(true);
  });
});
