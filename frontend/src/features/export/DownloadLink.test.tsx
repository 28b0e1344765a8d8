import { IconFileZip } from '@tabler/icons-react';
import { screen } from '@testing-library/react';
import { expect, it } from 'vitest';
import { show } from '../../../harness/testing';
import { DownloadLink } from './DownloadLink';

it('is a link that downloads', () => {
  show(
    <DownloadLink href="/project.zip" icon={IconFileZip} testId="zip">
      The project
    </DownloadLink>,
  );
  const link = screen.getByRole('link', { name: 'The project' });
  expect(link).toHaveAttribute('href', '/project.zip');
  expect(link).toHaveAttribute('download');
});
