import { act } from '@testing-library/react';
import { onTestFinished } from 'vitest';
import { setViewMode, showsProject } from '@/store/viewMode';

/** Shows the basic page until the test is over. */
export function basicPage(): void {
  act(() => setViewMode('basic'));
  onTestFinished(showsProject());
  onTestFinished(() => act(() => setViewMode('full')));
}
