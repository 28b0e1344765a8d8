import { Button, Group } from '@mantine/core';
import { notifications } from '@mantine/notifications';
import { IconBulb } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import { reasonOf } from '@/api/reason';
import { UnwritableError } from '@/model/document/rewrite';
import type { Fix } from '@/model/fixes';
import { applyFix, type TakeBack } from '@/store/project/edits/fixes';

interface QuickFixesProps {
  readonly tree: string;
  readonly fixes: readonly Fix[];
  /** Called after a fix was applied. */
  readonly onDone?: (() => void) | undefined;
}

/** The fixes of a finding as buttons; each can be undone. */
export function QuickFixes({ tree, fixes, onDone }: QuickFixesProps) {
  const { t } = useTranslation('editor');
  if (fixes.length === 0) return null;
  const act = async (fix: Fix) => {
    const applied = applyFix(tree, fix);
    onDone?.();
    try {
      const undo = await applied;
      if (undo) fixed(fix, undo);
      else if (typeof fix.does !== 'function' && fix.does.makes !== 'typing')
        notifications.show({ message: t('fixed.nothing') });
    } catch (error) {
      const message = error instanceof UnwritableError ? t('editor3d:unwritable') : reasonOf(error as Error);
      notifications.show({ color: 'red', message });
    }
  };
  const fixed = (fix: Fix, undo: TakeBack) => {
    const id = ['fix', fix.key, ...Object.values(fix.values)].join(' ');
    notifications.show({
      id,
      autoClose: 10_000,
      message: (
        <Group justify="space-between" wrap="nowrap">
          {t(`fixed.${fix.key}`, fix.values)}
          <Button
            size="compact-xs"
            variant="light"
            onClick={() => {
              if (!undo()) notifications.show({ message: t('fixed.changed') });
              notifications.hide(id);
            }}
          >
            {t('fixed.undo')}
          </Button>
        </Group>
      ),
    });
  };
  return (
    <Group gap={6} mt={4}>
      {fixes.map((fix) => (
        <Button
          key={fix.key + Object.values(fix.values).join(' ')}
          size="compact-xs"
          variant="light"
          data-testid={`fix-${fix.key}`}
          leftSection={<IconBulb size={13} aria-hidden="true" />}
          onClick={() => {
            void act(fix);
          }}
        >
          {t(`fix.${fix.key}`, fix.values)}
        </Button>
      ))}
    </Group>
  );
}
