import { Button } from '@mantine/core';
import { IconShare3 } from '@tabler/icons-react';
import { useEffect, useState } from 'react';
import { useTranslation } from 'react-i18next';
import { registerCommands } from '@/commands/registry';
import { useProjectStore } from '@/store/project';
import { ShareDialog } from './ShareDialog';
import { useMe } from './useMe';

/**
 * The button that opens the sharing dialogue of the open project; its owner sees it on servers with accounts.
 */
export function ShareButton() {
  const { t } = useTranslation('accounts');
  const me = useMe();
  const [isOpen, setOpen] = useState(false);
  const projectId = useProjectStore((state) => state.projectId);
  const name = useProjectStore((state) => state.name);
  const role = useProjectStore((state) => state.role);
  const canShare = me !== undefined && me.mode !== 'local' && role === 'owner' && projectId !== null;
  useEffect(
    () =>
      canShare
        ? registerCommands([
            {
              id: 'project.share',
              group: 'project',
              labelKey: 'accounts:share.button',
              icon: IconShare3,
              run: () => setOpen(true),
            },
          ])
        : undefined,
    [canShare],
  );
  if (!me || me.mode === 'local' || role !== 'owner' || projectId === null) return null;
  return (
    <>
      <Button
        size="xs"
        variant="light"
        leftSection={<IconShare3 size={15} />}
        onClick={() => setOpen(true)}
        data-testid="share"
      >
        {t('share.button')}
      </Button>
      <ShareDialog projectId={projectId} name={name} isOpen={isOpen} onClose={() => setOpen(false)} />
    </>
  );
}
