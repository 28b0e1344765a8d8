import { describe, expect, it } from 'vitest';
import { enumNames, NEW_ENUMS } from './enums';

describe('the names of enumerations', () => {
  it('are those of all enumerations, each once', () => {
    expect(enumNames(NEW_ENUMS)).toEqual(['RED', 'GREEN', 'BLUE']);
    expect(enumNames('{"enums": {"A": {"X": 1, "Y": 2}, "B": {"X": 1}}}')).toEqual(['X', 'Y']);
  });

  it.each([null, '', '[', '[]', '{}', '{"enums": []}', '{"enums": {"A": 3}}'])('are none in %s', (text) => {
    expect(enumNames(text)).toEqual([]);
  });
});
