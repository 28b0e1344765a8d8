import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { show, user } from '../../../harness/testing';
import { ReportSections } from './ReportSections';

const row = (text: string) => ({ key: text, text, icon: null, content: text });

it('folds its parts, leaves out empty ones, and copies all lines', async () => {
  const write = vi.spyOn(navigator.clipboard, 'writeText').mockResolvedValue();
  show(
    <ReportSections
      parts={[
        {
          heading: 'Left out',
          rows: [row('a'), row('b')],
          most: { count: 1, more: (count) => `${count} more` },
        },
        { heading: 'Assumed', rows: [] },
        { heading: 'Taken', rows: [row('c')], isFolded: true },
      ]}
    />,
  );
  expect(screen.getByText('1 more')).toBeInTheDocument();
  expect(screen.queryByText('Assumed')).toBeNull();
  expect(screen.getByText('Taken').closest('details')).not.toHaveAttribute('open');
  await user.click(screen.getByRole('button', { name: 'Copy the report' }));
  expect(write).toHaveBeenCalledExactlyOnceWith('Left out\n  a\n  b\nTaken\n  c');
  write.mockRestore();
});
