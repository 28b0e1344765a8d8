import { Overlay, Text } from '@mantine/core';
import { IconUpload } from '@tabler/icons-react';
import classes from './dropOverlay.module.css';

/** Covers the page while files are dragged over it. */
export function DropOverlay({ children }: { readonly children: string }) {
  return (
    <Overlay fixed zIndex={300} backgroundOpacity={0.5} blur={2} className={classes['overlay']}>
      <IconUpload size={40} />
      <Text size="lg" fw={600}>
        {children}
      </Text>
    </Overlay>
  );
}
