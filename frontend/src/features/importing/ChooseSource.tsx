import { Button, FileButton, Group, Stack, Text } from '@mantine/core';
import { IconFile, IconFolder, IconUpload } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { PartKind } from '@/api/imports';
import type { Source } from '@/store/dialogs/importing';
import { chooseAgain } from '@/ui/drop/chooseAgain';
import classes from './importing.module.css';
import { sourceOfFiles } from './source';
import { useFirstFocus } from './useFirstFocus';

const FILES =
  '.zip,.urdf,.xacro,.sdf,.world,.yaml,.yml,.pgm,.png,.jpg,.jpeg,.tga,.stl,.dae,.obj,.mtl,.glb,.gltf';

interface Props {
  readonly kind: PartKind | null;
  readonly onChoose: (source: Source) => void;
}

/** The area for files that are dragged, with buttons for those who choose them. */
export function ChooseSource({ kind, onChoose }: Props) {
  const { t } = useTranslation('importing');
  const first = useFirstFocus<HTMLButtonElement>();
  const take = (files: readonly File[]) => {
    if (files.length > 0) onChoose(sourceOfFiles(files));
  };
  return (
    <Stack className={classes['area'] ?? ''} align="center" gap="sm" data-testid="import-area">
      <IconUpload size={32} stroke={1.4} aria-hidden="true" />
      <Text fw={600} ta="center">
        {t('drop')}
      </Text>
      <Text size="sm" c="dimmed" ta="center" maw={520}>
        {t(`bring.${kind ?? 'any'}`)}
      </Text>
      <Group justify="center" gap="xs">
        <FileButton
          multiple
          accept={FILES}
          onChange={take}
          inputProps={{ ...chooseAgain, 'aria-label': t('files') }}
        >
          {(props) => (
            <Button {...props} ref={first} data-testid="import-files" leftSection={<IconFile size={16} />}>
              {t('files')}
            </Button>
          )}
        </FileButton>
        <FileButton
          multiple
          onChange={take}
          inputProps={{ ...chooseAgain, 'aria-label': t('folder'), ...({ webkitdirectory: '' } as object) }}
        >
          {(props) => (
            <Button
              {...props}
              variant="default"
              data-testid="import-folder"
              leftSection={<IconFolder size={16} />}
            >
              {t('folder')}
            </Button>
          )}
        </FileButton>
      </Group>
    </Stack>
  );
}
