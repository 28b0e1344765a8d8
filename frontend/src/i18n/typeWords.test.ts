import { afterEach, describe, expect, it } from 'vitest';
import { setLanguage } from '.';
import { typeName, typeWords } from './typeWords';

afterEach(() => setLanguage('en'));

describe('the types of ports', () => {
  it.each([
    ['int', 'a whole number', 'whole number'],
    ['uint', 'a whole number, 0 or more', 'whole number from 0'],
    ['double', 'a number', 'number'],
    ['bool', 'true or false', 'true or false'],
    ['string', 'a text', 'text'],
    ['any', 'a value', 'any'],
    ['Color[RED;GREEN]', 'one of RED, GREEN', 'Color'],
    ['list[uint]', 'a list such as 1;2;3, each a whole number, 0 or more', 'list'],
    ['package/msg/Name', 'a name such as package/msg/Name', 'package/msg/Name'],
    ['Pose', 'Pose', 'Pose'],
    ['', '', ''],
  ])('are words: %s', (type, words, name) => {
    expect([typeWords(type), typeName(type)]).toEqual([words, name]);
  });

  it('are words in each language', () => {
    setLanguage('es');
    expect([typeWords('uint'), typeName('double')]).toEqual(['un número entero, desde 0', 'número']);
  });
});
