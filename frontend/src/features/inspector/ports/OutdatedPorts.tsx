import { Button } from '@mantine/core';
import { IconAlertTriangle } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { openFile } from '@/store/project/navigation';
import { actionPath } from '@/store/project/state';
import { useProjectStore } from '@/store/project';
import classes from '../Inspector.module.css';

/** A notice that the ports are those of the last valid Python, with a link to the line of the error. */
export function OutdatedPorts({ action }: { readonly action: string }) {
  const { t } = useTranslation('inspector');
  const line = useProjectStore(
    (state) => state.actions.find(({ name }) => name === action)?.diagnostics?.[0]?.line ?? 1,
  );
  const path = actionPath(action);
  return (
    <div className={classes['problem']} data-severity="warning" role="status" data-testid="outdated-ports">
      <IconAlertTriangle size={16} aria-hidden="true" />
      <span>
        {t('outdatedPorts')}{' '}
        <Button
          size="compact-xs"
          variant="light"
          color="gray"
          onClick={() => {
            openFile(path, line);
          }}
        >
          {t('openBrokenLine', { file: `${action}.py`, line })}
        </Button>
      </span>
    </div>
  );
}
