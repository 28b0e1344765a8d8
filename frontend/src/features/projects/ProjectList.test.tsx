import { MantineProvider } from '@mantine/core';
import { QueryClientProvider } from '@tanstack/react-query';
import { cleanup, render, screen } from '@testing-library/react';
import { afterEach, expect, it, vi } from 'vitest';
import { api } from '@/api/client';
import { queries } from '@/api/queries';
import type { ProjectSummary } from '@/api/types';
import '@/i18n';
import { theme } from '@/ui/theme';
import { ProjectList } from './ProjectList';
import { useProjectCommands } from './useProjects';

function answer(...names: string[]): void {
  const items = names.map((name) => ({ id: name, name, updated_at: '2026-01-01T00:00:00Z' }));
  const page = { items: items as ProjectSummary[], total: items.length, next_offset: null };
  vi.spyOn(api, 'listProjects').mockResolvedValue(page);
}

function List() {
  return <ProjectList actions={useProjectCommands()} searchField={{ current: null }} />;
}

function open(): void {
  render(
    <QueryClientProvider client={queries}>
      <MantineProvider theme={theme} env="test">
        <List />
      </MantineProvider>
    </QueryClientProvider>,
  );
}

afterEach(() => {
  cleanup();
  queries.clear();
});

it('shows a project that was made since the list was seen, however soon', async () => {
  answer();
  open();
  expect(await screen.findByText('No projects yet')).toBeTruthy();
  cleanup();
  answer('Bump and go');
  open();
  expect(screen.queryByText('No projects yet')).toBeNull();
  expect(await screen.findByText('Bump and go')).toBeTruthy();
});
