import { Button } from '@mantine/core';
import { IconMaximize } from '@tabler/icons-react';
import { useReactFlow, useStore, type ReactFlowState } from '@xyflow/react';
import { useCallback } from 'react';
import { useTranslation } from 'react-i18next';
import type { Layout } from '@/model/layout';
import classes from '../Canvas.module.css';
import { FIT } from './useViewport';

interface OutOfSightProps {
  readonly layout: Layout;
  /** Called when the view returns to the tree. */
  readonly onBack: () => void;
}

/** The button that returns to the tree, shown while no block is in view. */
export function OutOfSight({ layout, onBack }: OutOfSightProps) {
  const { t } = useTranslation('canvas');
  const flow = useReactFlow();
  const isLost = useStore(
    useCallback(
      ({ width, height, transform: [x, y, zoom] }: ReactFlowState) => {
        const boxes = Object.values(layout.positions);
        return (
          width > 0 &&
          boxes.length > 0 &&
          !boxes.some(
            (box) =>
              box.x * zoom + x < width &&
              box.y * zoom + y < height &&
              (box.x + box.width) * zoom + x > 0 &&
              (box.y + box.height) * zoom + y > 0,
          )
        );
      },
      [layout],
    ),
  );
  if (!isLost) return null;
  return (
    <Button
      className={classes['outOfSight'] ?? ''}
      size="xs"
      variant="default"
      leftSection={<IconMaximize size={15} aria-hidden="true" />}
      data-testid="back-to-tree"
      onClick={() => {
        void flow.fitView({ ...FIT, duration: 200 });
        onBack();
      }}
    >
      {t('backToTree')}
    </Button>
  );
}
