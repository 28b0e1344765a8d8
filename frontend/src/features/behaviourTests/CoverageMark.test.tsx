import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { CoverageMark, LevelSign } from './CoverageMark';

it('says its level in words', () => {
  show(<CoverageMark level="partly" width={10} height={5} />);
  expect(screen.getByRole('img', { name: 'Partly covered' })).toHaveAttribute('data-level', 'partly');
});

it('has another shape for each level', () => {
  const shapes = (['never', 'partly', 'fully'] as const).map((level) => {
    const { container, unmount } = show(<LevelSign level={level} />);
    const shape = [...container.querySelectorAll('svg > *')].map(
      (part) => part.getAttribute('d') ?? part.tagName,
    );
    unmount();
    return shape.join(' ');
  });
  expect(new Set(shapes).size).toBe(3);
  // Statuses are round.
  expect(shapes.join(' ')).not.toContain('circle');
});
