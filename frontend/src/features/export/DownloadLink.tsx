import { Button } from '@mantine/core';
import type { ComponentType, ReactNode } from 'react';

interface DownloadLinkProps {
  readonly href: string;
  readonly icon: ComponentType<{ size?: number | string }>;
  readonly testId: string;
  readonly variant?: 'default' | 'filled';
  readonly children: ReactNode;
}

/** A button that downloads a file of the server. */
export function DownloadLink({ href, icon: Icon, testId, variant = 'default', children }: DownloadLinkProps) {
  return (
    <Button
      component="a"
      variant={variant}
      href={href}
      download
      data-testid={testId}
      leftSection={<Icon size={16} />}
    >
      {children}
    </Button>
  );
}
