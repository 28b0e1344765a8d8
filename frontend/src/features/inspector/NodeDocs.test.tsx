import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { vocabulary } from '@/model/testing';
import type { NodeSpec } from '@/model/vocabulary';
import { show } from '../../../harness/testing';
import { NodeDocs } from './NodeDocs';

const spec = (more: Partial<NodeSpec>): NodeSpec => ({
  ...vocabulary.specs.get('Turn')!,
  summary: 'Turns the robot.',
  ...more,
});

describe('NodeDocs', () => {
  it.each([undefined, spec({ summary: '' })])('is absent without a description', (known) => {
    const { container } = show(<NodeDocs spec={known} />);
    expect(container.querySelector('h3')).toBeNull();
  });

  it('describes a block', () => {
    show(<NodeDocs spec={spec({})} />);
    expect(screen.getByRole('heading', { name: 'About this node' })).toBeInTheDocument();
    expect(screen.getByText('Turns the robot.')).toBeInTheDocument();
    expect(screen.queryByText(/Children/)).toBeNull();
  });

  it.each([
    [1, 1, 'Children: 1'],
    [2, 3, 'Children: 2–3'],
    [0, Infinity, 'Children: 0+'],
  ])('says that it takes %s to %s children', (minChildren, maxChildren, text) => {
    show(<NodeDocs spec={spec({ minChildren, maxChildren })} />);
    expect(screen.getByText(text)).toBeInTheDocument();
  });
});
