import { Button, Group } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { NodeId } from '@/model/diagram';
import { openFile } from '@/store/project/navigation';
import { useShownSession } from '@/store/moment/session';
import classes from './Inspector.module.css';

interface FaultOfRunProps {
  readonly tree: string;
  readonly id: NodeId;
  readonly message: string;
}

/** The fault of the block in the last run, with a link to its line. */
export function FaultOfRun({ tree, id, message }: FaultOfRunProps) {
  const { t } = useTranslation('run');
  const fault = useShownSession((state) =>
    state.faults.findLast((each) => each.tree_id === tree && each.node_id === id),
  );
  return (
    <li className={classes['problem']} data-severity="error" data-testid="fault-of-run">
      <IconAlertTriangle size={16} aria-hidden="true" />
      <span>
        <strong>
          {t(`banner.fault.${fault?.kind ?? 'exception'}`)} {message}
        </strong>{' '}
        {fault?.hint}
        {fault?.file && fault.line > 0 ? (
          <Group mt={4}>
            <Button
              size="compact-xs"
              variant="light"
              color="red"
              onClick={() => {
                openFile(fault.file, fault.line);
              }}
            >
              {t('openLine', { file: fault.file.split('/').at(-1), line: fault.line })}
            </Button>
          </Group>
        ) : null}
      </span>
    </li>
  );
}
