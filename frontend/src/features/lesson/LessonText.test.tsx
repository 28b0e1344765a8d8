import { screen, within } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import { parseLesson } from '@/model/lesson/parse';
import { show, user } from '../../../harness/testing';
import { LessonText } from './LessonText';

it('draws each kind of block, and its buttons', async () => {
  const onTry = vi.fn();
  const text =
    '# One\n## Two\n### Three\n\n*a* `b`\n\n- first\n- [Look](try:select=Go)\n\n1. then\n\n```\ncode\n```';
  show(<LessonText blocks={parseLesson(text)} onTry={onTry} />);
  expect([2, 3, 4].map((level) => screen.getByRole('heading', { level }).textContent)).toEqual([
    'One',
    'Two',
    'Three',
  ]);
  const [bullets, numbers] = screen.getAllByRole('list');
  expect(within(bullets!).getAllByRole('listitem')).toHaveLength(2);
  expect(numbers?.tagName).toBe('OL');
  expect(screen.getByText('code').tagName).toBe('PRE');
  await user.click(screen.getByRole('button', { name: 'Look' }));
  expect(onTry).toHaveBeenCalledExactlyOnceWith({ kind: 'select', block: 'Go' });
});
