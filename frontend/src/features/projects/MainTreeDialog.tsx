import { Button, Group, Modal, Radio, ScrollArea, Stack, Text } from '@mantine/core';
import { useState } from 'react';
import { useTranslation } from 'react-i18next';
import type { MainTreeOffer } from './useImport';

interface Props {
  readonly offer: MainTreeOffer;
  readonly onChoose: (main: string) => void;
  readonly onClose: () => void;
}

/** A dialogue that asks which tree of several files is the main tree. */
export function MainTreeDialog({ offer, onChoose, onClose }: Props) {
  const { t } = useTranslation('projects');
  const [main, setMain] = useState(offer.choices[0]?.main ?? '');
  return (
    <Modal opened onClose={onClose} title={t('mainTree.title')} size="lg">
      <Radio.Group
        value={main}
        onChange={setMain}
        label={t('mainTree.text', { file: offer.asked.file.name })}
        mb="md"
      >
        <ScrollArea.Autosize mah="50vh">
          <Stack gap="xs" mt="xs">
            {offer.choices.map((choice) => (
              <Radio
                key={choice.main}
                value={choice.main}
                label={choice.tree}
                description={
                  <Text span size="xs">
                    {choice.file}
                  </Text>
                }
              />
            ))}
          </Stack>
        </ScrollArea.Autosize>
      </Radio.Group>
      <Group justify="end">
        <Button variant="default" onClick={onClose}>
          {t('repair.decline')}
        </Button>
        <Button onClick={() => onChoose(main)} data-testid="choose-main" data-autofocus>
          {t('mainTree.accept')}
        </Button>
      </Group>
    </Modal>
  );
}
