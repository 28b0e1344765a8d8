import i18next from 'i18next';
import { readdirSync, readFileSync } from 'node:fs';
import { afterEach, describe, expect, it } from 'vitest';
import { setLanguage } from '.';
import './editorTexts';
import { shippedDoc, shippedPort } from './shipped';
import english from './locales/en/shipped.json';

afterEach(() => setLanguage('en'));

describe('what shipped actions say', () => {
  it('is translated to the language of the page', () => {
    setLanguage('es');
    expect(shippedDoc('Turn', 'Turns on the spot.')).toBe('Gira sobre sí mismo.');
    expect(shippedPort('Forward', 'lin_speed', 'Speed ahead in m/s.')).toBe('Velocidad de avance en m/s.');
  });

  it('stays as the user wrote it', () => {
    setLanguage('es');
    expect(shippedDoc('Turn', 'Turns slowly.')).toBe('Turns slowly.');
    expect(shippedPort('Mine', 'speed', 'Speed ahead in m/s.')).toBe('Speed ahead in m/s.');
    expect(shippedPort('Turn', 'toString', 'x')).toBe('x');
  });

  it('equals the examples in English', () => {
    const folder = '../examples';
    const sources = readdirSync(folder, { recursive: true, encoding: 'utf8' })
      .filter((path) => /actions\/\w+\.py$/.test(path))
      .map((path) => readFileSync(`${folder}/${path}`, 'utf8'))
      .join('\n');
    const texts = Object.values(english).flatMap((all) =>
      all.flatMap(({ doc, ports }) => [doc, ...Object.values(ports)]),
    );
    expect(texts.filter((text) => !sources.includes(text))).toEqual([]);
    expect(i18next.hasResourceBundle('es', 'shipped')).toBe(true);
  });
});
