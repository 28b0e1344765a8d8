import { Button, FileButton } from '@mantine/core';
import { IconFolderOpen } from '@tabler/icons-react';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import { chooseAgain } from '@/ui/drop/chooseAgain';
import { LOG_ENDINGS } from './openNewLog';

/** A button that opens the log of a robot on the time axis. */
export function LogButton({ onOpen }: { readonly onOpen: (file: File) => Promise<void> }) {
  const { t } = useTranslation('runs');
  const [isReading, setReading] = useState(false);
  const open = async (file: File | null) => {
    if (!file) return;
    setReading(true);
    await onOpen(file);
    setReading(false);
  };
  return (
    <FileButton onChange={(file) => void open(file)} accept={LOG_ENDINGS.join(',')} inputProps={chooseAgain}>
      {(props) => (
        <Button
          {...props}
          variant="default"
          size="compact-sm"
          loading={isReading}
          leftSection={<IconFolderOpen size={16} />}
          title={t('log.kinds')}
        >
          {t('log.open')}
        </Button>
      )}
    </FileButton>
  );
}
