import { expect, it } from 'vitest';
import { makeVocabulary } from '@/model/vocabulary';
import type { RecordedNode } from '@/store/recording/types';
import { withRecorded } from './vocabulary';

const ran = (type: string, kind: string) =>
  ({ type, kind, ports: { speed: '1' } }) as unknown as RecordedNode;

it('adds types that the project does not have, with their kinds and ports', () => {
  const present = makeVocabulary([]);
  const { specs } = withRecorded(present, [ran('Wave', 'condition'), ran('Wave', 'action')]);
  expect(specs.get('Wave')).toMatchObject({ family: 'condition', ports: [{ name: 'speed' }] });
  expect(present.specs.size).toBe(0);
  expect(withRecorded(present, [])).toBe(present);
});
